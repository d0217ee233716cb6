// The tiers of agreement between two pictures of one thing, the strictest first.
// core/image/compare/tiers.c has their thresholds.
#ifndef RG_CORE_BASE_TIER_H
#define RG_CORE_BASE_TIER_H

enum rg_tier {
    RG_T0, // identical: every bit
    RG_T1, // arithmetic: equal up to rounding
    RG_T2, // geometry: the same things in the same places, drawn in another way
};
enum { RG_TIER_COUNT = RG_T2 + 1 };

// "T0", "T1", "T2".
const char *rg_tier_name(enum rg_tier tier);

#endif
