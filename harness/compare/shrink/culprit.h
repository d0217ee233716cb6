// Finds the single dispatch that causes a stage's difference: run alone on both devices from the
// same inputs, it gives different bits.
#ifndef RG_HARNESS_COMPARE_SHRINK_CULPRIT_H
#define RG_HARNESS_COMPARE_SHRINK_CULPRIT_H

#include "harness/compare/blame/blame.h"
#include "harness/compare/blame/fall.h"

// The owner calls rg_culprit_free.
struct rg_culprit {
    bool found;
    struct rg_dispatched due; // reduced to the fewest items, with the truth's results
    int64_t items, of_items;  // number of items after and before the reduction
    char why_not[1400];       // one line, if nothing was found
};

// Records the dispatches of the blamed stage as `device` makes them; for a draw, those of its
// packing kernels. Runs each alone on both devices from its recorded inputs. The culprit is the
// first that differs. Then halves its items along each axis and zeroes its inputs, as long as it
// still differs and until `end_ms` (rg_now_ms).
//
// If the device fails (`fall`; NULL: it does not), the dispatches are recorded on the truth, and
// the culprit is the first on which the device fails, in whatever way. False, and one logged line,
// if a device fails otherwise.
bool rg_culprit_find(const struct rg_digest_run *run, const struct rg_blame *blame,
                     const struct rg_fall *fall, struct rg_device *device, struct rg_device *truth,
                     double end_ms, struct rg_culprit *culprit);
void rg_culprit_free(struct rg_culprit *culprit);

#endif
