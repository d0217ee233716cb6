// Compares two picture files: `raingauge diff A B`.
#ifndef RG_HARNESS_COMPARE_DIFF_FILES_H
#define RG_HARNESS_COMPARE_DIFF_FILES_H

#include <stdbool.h>

#include "core/image/compare/compare.h"

struct rg_diff_request {
    const char *a, *b;          // files
    const char *background;     // NULL: none; the rain mask is the whole picture then
    const char *heatmap_prefix; // NULL: none; else a prefix as for rg_pair_heatmaps
    bool json;                  // instead of a table
    struct rg_compare_options options;
};

// Prints the comparison of `b` with `a` to stdout. Returns an enum rg_exit: pass when they are
// bitwise equal (T0) and have equal extras; usage, with one logged line, for bad input or a heat
// map that cannot be written.
int rg_diff_files(const struct rg_diff_request *request);

#endif
