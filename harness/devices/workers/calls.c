#include "harness/devices/workers/calls.h"

const char *rg_call_doing(enum rg_call call)
{
    static const char *const doing[RG_CALL_COUNT_OF_CALLS] = {
        [RG_CALL_HELLO] = "greeting",
        [RG_CALL_LIST] = "listing devices",
        [RG_CALL_OPEN] = "opening the device",
        [RG_CALL_CLOSE] = "closing the device",
        [RG_CALL_PROBE] = "probing its arithmetic",
        [RG_CALL_AUDIT] = "auditing its timer",
        [RG_CALL_CEILINGS] = "measuring its ceilings",
        [RG_CALL_SESSION_OPEN] = "opening a technique",
        [RG_CALL_SESSION_CLOSE] = "closing a technique",
        [RG_CALL_STEP] = "simulating a frame",
        [RG_CALL_DRAW] = "drawing a frame",
        [RG_CALL_SYNC] = "waiting for the device",
        [RG_CALL_FRAMES] = "simulating and drawing frames",
        [RG_CALL_COUNT] = "counting a frame's work",
        [RG_CALL_STAGES] = "timing a frame's passes",
        [RG_CALL_TIME] = "asking for the device's time",
        [RG_CALL_CODE] = "telling of its code",
        [RG_CALL_READ] = "reading the picture",
        [RG_CALL_TELL] = "telling of a technique",
        [RG_CALL_READ_STATE] = "reading the state",
        [RG_CALL_OBEYS] = "checking a law",
        [RG_CALL_TEXTURE] = "telling of a texture",
        [RG_CALL_DIGESTS] = "digesting stages",
        [RG_CALL_CONTENTS] = "reading an asset",
        [RG_CALL_DISPATCHES] = "keeping a stage's dispatches",
        [RG_CALL_DISPATCH] = "running a kernel alone",
        [RG_CALL_KERNEL_CODE] = "reading a kernel's code",
    };
    return doing[call];
}
