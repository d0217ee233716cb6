#include "core/base/tier.h"

const char *rg_tier_name(enum rg_tier tier)
{
    static const char *const names[RG_TIER_COUNT] = {"T0", "T1", "T2"};
    return names[tier];
}
