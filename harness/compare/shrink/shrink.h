// Reduces a difference between two devices to the smallest run that still has it.
#ifndef RG_HARNESS_COMPARE_SHRINK_SHRINK_H
#define RG_HARNESS_COMPARE_SHRINK_SHRINK_H

#include "harness/compare/shrink/case.h"

struct rg_shrink_request {
    struct rg_digest_run run;
    struct rg_device *device, *truth;
    int seconds;        // limit, after which nothing more is tried
    const char *folder; // for files that were reduced
};

// Tries fewer frames and pixels, default parameters, and smaller weights (struct rg_digest):
// counts, choices, files with fewer entries and real numbers. The stage, asset and class of the
// difference must stay the same. `found` gets the smallest run, whose settings the caller frees,
// `blame` its difference, `tried` the number of attempts. Returns an exit status, after one logged
// line if it is not RG_EXIT_PASS: RG_EXIT_FAIL if nothing differs, the error's if a device fails at
// once. A device that fails later ends the search, with one logged line.
int rg_shrink_case(const struct rg_shrink_request *request, struct rg_case *found,
                   struct rg_blame *blame, int *tried);

#endif
