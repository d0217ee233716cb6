#include "core/base/outcome.h"

#include <string.h>

static const char *const names[RG_OUTCOME_COUNT] = {
    [RG_OK] = "ok",           [RG_FAIL] = "fail",     [RG_UNSUPPORTED] = "unsupported",
    [RG_ERROR] = "error",     [RG_CRASH] = "crash",   [RG_TIMEOUT] = "timeout",
    [RG_NOTHING] = "nothing", [RG_LACKING] = "error", [RG_SETUP] = "error",
};

const char *rg_outcome_name(enum rg_outcome outcome)
{
    return names[outcome];
}

bool rg_outcome_find(const char *name, enum rg_outcome *outcome)
{
    for (int i = 0; i < RG_OUTCOME_COUNT; i++) {
        if (strcmp(name, names[i]))
            continue;
        *outcome = (enum rg_outcome)i;
        return true;
    }
    return false;
}

bool rg_outcome_is_broken(enum rg_outcome outcome)
{
    return outcome == RG_ERROR || outcome == RG_CRASH || outcome == RG_TIMEOUT ||
           outcome == RG_LACKING || outcome == RG_SETUP;
}
