// Counts the commands that are queued and not known to have ended.
#include "backends/opencl/opencl.h"

#include <stdlib.h>

// Some drivers begin work only on a flush, but a flush for each command would cost as much as a
// small run.
enum { COMMANDS_A_FLUSH = 16 };

// Flushes before a command, never after it: rusticl's clFinish (Mesa 22.3.6) does not wait for
// flushed commands if none follows.
bool opencl_will_queue(struct opencl_device *device)
{
    const bool is_due = device->queued && device->queued % COMMANDS_A_FLUSH == 0;
    device->queued++;
    return !is_due ||
           opencl_check(clFlush(device->queue), "clFlush", "device", device->pub.info.name);
}

void opencl_ended(struct opencl_device *device)
{
    device->queued = 0;
    device->staged_bytes = 0;
    while (device->staged) {
        struct opencl_staged *next = device->staged->next;
        free(device->staged);
        device->staged = next;
    }
}
