#include "core/device/tier.h"

enum rg_tier rg_tier_owed(const struct rg_device_info *a, const struct rg_device_info *b)
{
    return a->tier > b->tier ? a->tier : b->tier;
}
