// How closely two pictures of one thing agree: the tiers, from the strictest on. What each asks for
// is in core/image/compare/tiers.c.
#ifndef RG_CORE_BASE_TIER_H
#define RG_CORE_BASE_TIER_H

enum rg_tier {
    RG_T0, // identical: every bit
    RG_T1, // arithmetic: what other roundings come to
    RG_T2, // geometry: the same things in the same places, by another way of drawing
};
enum { RG_TIER_COUNT = RG_T2 + 1 };

// "T0", "T1", "T2".
const char *rg_tier_name(enum rg_tier tier);

#endif
