// Describes the messages that a worker understands, so that another build is told from a damaged
// worker.
#include <stdio.h>

#include "core/device/probe.h"
#include "harness/devices/frames/digests.h"
#include "harness/devices/measure/serving/services.h"
#include "harness/devices/measure/serving/serving.h"

// Raise it if calls and sizes stay the same but mean something else.
enum { FORMAT = 8 };

const char *rg_serving_hello(void)
{
    static char text[120];
    snprintf(text, sizeof(text),
             "raingauge messages %d: %d calls, %d operations, sizes %zu %zu %zu %zu", FORMAT,
             RG_CALL_COUNT_OF_CALLS, RG_PROBE_COUNT, sizeof(struct rg_device_info),
             sizeof(struct rg_tally), sizeof(struct rg_image_desc), sizeof(struct rg_digest));
    return text;
}

bool rg_serve_hello(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_text(reply, rg_serving_hello());
    return true;
}
