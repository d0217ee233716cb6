// What two devices owe each other.
#ifndef RG_CORE_DEVICE_TIER_H
#define RG_CORE_DEVICE_TIER_H

#include "backends/backend.h"

// The tier that pictures of the two must hold, in either order: the looser of theirs, for what one
// of them may differ by from cpu:reference it may differ by from the other.
enum rg_tier rg_tier_owed(const struct rg_device_info *a, const struct rg_device_info *b);

#endif
