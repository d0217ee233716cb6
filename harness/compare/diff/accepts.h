// What it would cost to let a pair pass that does not hold what its devices owe each other: the
// tier that would hold, and the models, a little off, that nobody would notice then.
#ifndef RG_HARNESS_COMPARE_DIFF_ACCEPTS_H
#define RG_HARNESS_COMPARE_DIFF_ACCEPTS_H

#include <jansson.h>

#include "core/image/compare/compare.h"
#include "harness/compare/verify/verify.h"

// What is known by tier, so that each tier's mutants are drawn once. Zeroed: nothing.
struct rg_accepts {
    bool is_known[RG_TIER_COUNT];
    struct rg_mutants_told of[RG_TIER_COUNT];
};

// Says in a line which tier would hold, and, if the mutants are `wanted`, which of the technique's
// that tier accepts, which `cpu` draws. Returns the same for machines where `as_json`, which the
// caller owns, and prints nothing then. NULL, and one logged line, where drawing fails.
json_t *rg_accepts_tell(struct rg_accepts *accepts, const struct rg_technique *technique,
                        const struct rg_tiers *tiers, bool wanted, bool as_json);

#endif
