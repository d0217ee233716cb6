#include "backends/cpu/cpu.h"

#include <time.h>

// Passes run during their call; nothing is ever queued.
bool cpu_sync(struct rg_device *device)
{
    (void)device;
    return true;
}

bool cpu_time(struct rg_device *device, int64_t *time_ns)
{
    (void)device;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    *time_ns = (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
    return true;
}
