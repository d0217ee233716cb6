#include "harness/devices/workers/calls.h"

#define DOING(name, service, doing) [RG_CALL_##name] = (doing),

const char *rg_call_doing(enum rg_call call)
{
    static const char *const doing[RG_CALL_COUNT_OF_CALLS] = {RG_CALLS(DOING)};
    return doing[call];
}
