// How far printed numbers can be from what was measured for them.
#ifndef RG_HARNESS_TABLES_CLAIMS_MARGIN_H
#define RG_HARNESS_TABLES_CLAIMS_MARGIN_H

#include <stdbool.h>

#include "harness/record/slope.h"

// Half of the last digit that a number has in print, as a share of it: 22.5 is anything from 22.45
// to 22.55, and 0.05 / 22.5. NAN, where nothing is printed, has none.
double rg_margin_rounding(double printed);
// Whether the first is larger than the second by more than rounding hides.
bool rg_margin_orders(double larger, double smaller);

// How far the slope of printed frame rates along the axis can be from that of the rows' own rates,
// with 95 %: by rounding, and by how much each row is off the line between its neighbours, as a
// standard deviation of what all rows scatter. Points are in the order of the axis, by group, and
// have weights.
double rg_margin_slope(const struct rg_slope_point *points, const double *weights,
                       const double *printed, int count);

#endif
