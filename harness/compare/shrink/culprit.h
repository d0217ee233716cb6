// The one run of a kernel behind a difference of a stage: what leaves other bits on one device than
// on the other when it is run alone, from the same inputs.
#ifndef RG_HARNESS_COMPARE_SHRINK_CULPRIT_H
#define RG_HARNESS_COMPARE_SHRINK_CULPRIT_H

#include "harness/compare/blame/blame.h"
#include "harness/compare/blame/fall.h"

// The owner calls rg_culprit_free.
struct rg_culprit {
    bool found;
    struct rg_dispatched due; // of the fewest items, with what the truth leaves after it
    int64_t items, of_items;  // how many, and of how many
    char why_not[1400];       // where none is found: a line
};

// Keeps the dispatches of the stage that is blamed as `device` makes them, of a draw those that
// pack it, and runs each alone on both from what lay there before. The first that differs is the
// culprit; its items are halved along each axis as often as it still differs, and then what lay in
// its slots is zeroed wherever it still does, until `end_ms` (rg_now_ms). False, and one logged
// line, where a device fails. Where the device fails (`fall`; NULL: it does not), they are as the
// truth makes them, and the culprit is the first at which it fails, however it does.
bool rg_culprit_find(const struct rg_digest_run *run, const struct rg_blame *blame,
                     const struct rg_fall *fall, struct rg_device *device, struct rg_device *truth,
                     double end_ms, struct rg_culprit *culprit);
void rg_culprit_free(struct rg_culprit *culprit);

#endif
