// Draws a column of numbers as a line of block characters.
#ifndef RG_HARNESS_TABLES_SHEET_CURVE_H
#define RG_HARNESS_TABLES_SHEET_CURVE_H

#include <stdio.h>

#include "harness/record/result.h"

// Prints the published curve of a work and variant, and each device's. A curve shows logarithms of
// frame rates, the least at the bottom and the most at the top. A missing one is a dot, and a space
// marks a restart of the axis. Prints nothing for fewer than three rows, or without an axis.
void rg_curves_print(const struct rg_result *result, struct rg_place of, FILE *out);

#endif
