// The slope of medians of samples along an axis, with its confidence interval.
#ifndef RG_HARNESS_RECORD_SLOPE_H
#define RG_HARNESS_RECORD_SLOPE_H

#include "core/base/stats.h"

// A point on the axis. Each group has a line of its own, but all lines share one slope.
struct rg_slope_point {
    double x;
    int group;             // any number
    const double *samples; // positive; not owned
    int count;             // number of samples, at most RG_SLOPE_SAMPLES
    double load_ms;        // time of the calibration load then; 0: unknown
};

enum { RG_SLOPE_POINTS = 256, RG_SLOPE_SAMPLES = 256 };

// The weight of each y in the slope of the least-squares lines through (x, y): the slope is the sum
// of weight * y. All are NAN if no group has two different x.
void rg_slope_weights(const struct rg_slope_point *points, int count, double *weights);

// The slope of the logarithm of the samples' medians, with its 95 % interval by bootstrap. Each
// point's samples are drawn with replacement, 2000 times, always in the same way. The interval is
// the middle 95 % of the resulting slopes (Efron's percentiles). If the load's times also have a
// slope, it widens the interval on either side. No interval if a point has fewer than
// RG_LEAST_SAMPLES; all NAN without weights.
struct rg_interval rg_slope_resampled(const struct rg_slope_point *points, int count);

#endif
