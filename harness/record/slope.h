// How steeply medians of samples go along an axis, and how sure that is.
#ifndef RG_HARNESS_RECORD_SLOPE_H
#define RG_HARNESS_RECORD_SLOPE_H

#include "harness/record/stats.h"

// A place on the axis. Of several groups, each has a line of its own, and all have one slope.
struct rg_slope_point {
    double x;
    int group;             // any number
    const double *samples; // positive; not owned
    int count;             // of them; at most RG_SLOPE_SAMPLES
    double load_ms;        // what a load that is always the same took meanwhile; 0: unknown
};

enum { RG_SLOPE_POINTS = 256, RG_SLOPE_SAMPLES = 256 };

// What each y weighs in the slope of the least-squares lines through (x, y): the slope is the sum
// of y by weight. All are NAN where no group has two different x.
void rg_slope_weights(const struct rg_slope_point *points, int count, double *weights);

// The slope of the logarithm of the samples' medians, and its interval of 95 % by resampling: each
// point's samples are drawn anew with replacement, 2000 times, and the middle 95 % of the slopes of
// those are the interval (Efron's percentiles). Always the same draws. Where the load's times have
// a slope, too, that may be all that the samples' is off by, on either side. No interval where a
// point has fewer than RG_LEAST_SAMPLES; all NAN without weights.
struct rg_interval rg_slope_resampled(const struct rg_slope_point *points, int count);

#endif
