// The errors of printed numbers.
#ifndef RG_HARNESS_TABLES_CLAIMS_MARGIN_H
#define RG_HARNESS_TABLES_CLAIMS_MARGIN_H

#include <stdbool.h>

#include "harness/record/slope.h"

// The relative rounding error of a printed number: 22.5 stands for 22.45 to 22.55, so 0.05 / 22.5.
// NAN for NAN.
double rg_margin_rounding(double printed);
// Whether the first is larger than the second despite rounding.
bool rg_margin_orders(double larger, double smaller);

// The 95 % error of the slope of printed frame rates along the axis. It combines rounding with the
// rows' deviations from the line between their neighbours, as a standard deviation. Points are
// sorted by group and axis, and have weights.
double rg_margin_slope(const struct rg_slope_point *points, const double *weights,
                       const double *printed, int count);

#endif
