// Reduces a difference between two devices to the least that still has it.
#ifndef RG_HARNESS_COMPARE_SHRINK_SHRINK_H
#define RG_HARNESS_COMPARE_SHRINK_SHRINK_H

#include "harness/compare/shrink/case.h"

struct rg_shrink_request {
    struct rg_digest_run run;
    struct rg_device *device, *truth;
    int seconds;        // after which nothing more is tried
    const char *folder; // where files that have been made smaller are put
};

// Tries fewer frames and pixels, defaults of parameters, and what weighs less (struct rg_digest):
// counts, choices, files with fewer entries and real numbers; as long as the same stage differs in
// the same asset and class. `found` gets the least, whose settings the caller frees, and `blame`
// what it comes to; `tried`, how many were. Returns an exit status, after one logged line where it
// is not RG_EXIT_PASS: RG_EXIT_FAIL where nothing differs, that of the error where a device fails
// at once; one that fails later ends the search, which is one line too.
int rg_shrink_case(const struct rg_shrink_request *request, struct rg_case *found,
                   struct rg_blame *blame, int *tried);

#endif
