// The curve of a column of numbers, as a line of blocks.
#ifndef RG_HARNESS_TABLES_SHEET_CURVE_H
#define RG_HARNESS_TABLES_SHEET_CURVE_H

#include <stdio.h>

#include "harness/record/result.h"

// Prints the published curve of a work and variant, and beside it that of each device: frame rates
// by their logarithms, the least at the bottom and the most at the top; a dot where there is none,
// a space where the axis begins anew. Prints nothing of fewer than three rows, or without an axis.
void rg_curves_print(const struct rg_result *result, struct rg_place of, FILE *out);

#endif
