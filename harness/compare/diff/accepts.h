// The cost of letting a pair pass that fails its devices' tier: the looser tier that would pass,
// and the mutants that this tier would no longer notice.
#ifndef RG_HARNESS_COMPARE_DIFF_ACCEPTS_H
#define RG_HARNESS_COMPARE_DIFF_ACCEPTS_H

#include <jansson.h>

#include "core/image/compare/compare.h"
#include "harness/compare/verify/verify.h"

// Results by tier, so that each tier's mutants are drawn once. Zeroed: none.
struct rg_accepts {
    bool is_known[RG_TIER_COUNT];
    struct rg_mutants_told of[RG_TIER_COUNT];
};

// Prints a line saying which tier would hold, and, if `wanted`, which of the technique's mutants
// that tier accepts, as drawn by `cpu`. With `as_json` prints nothing and returns the same as JSON,
// which the caller owns. NULL, and one logged line, if drawing fails.
json_t *rg_accepts_tell(struct rg_accepts *accepts, const struct rg_technique *technique,
                        const struct rg_tiers *tiers, bool wanted, bool as_json);

#endif
