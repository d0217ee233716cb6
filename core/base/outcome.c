#include "core/base/outcome.h"

#include <string.h>

#include "core/base/log.h"

static const char *const names[RG_OUTCOME_COUNT] = {
    [RG_OK] = "ok",           [RG_FAIL] = "fail",   [RG_UNSUPPORTED] = "unsupported",
    [RG_ERROR] = "error",     [RG_CRASH] = "crash", [RG_TIMEOUT] = "timeout",
    [RG_NOTHING] = "nothing",
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
    return outcome == RG_ERROR || outcome == RG_CRASH || outcome == RG_TIMEOUT;
}

enum rg_outcome rg_outcome_of_error(void)
{
    switch (rg_last_error_kind()) {
    case RG_ERROR_UNSUPPORTED:
        return RG_UNSUPPORTED;
    case RG_ERROR_CRASH:
        return RG_CRASH;
    case RG_ERROR_TIMEOUT:
        return RG_TIMEOUT;
    default:
        return RG_ERROR;
    }
}
