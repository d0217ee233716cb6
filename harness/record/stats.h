// Medians and their intervals.
#ifndef RG_HARNESS_RECORD_STATS_H
#define RG_HARNESS_RECORD_STATS_H

struct rg_interval {
    double median, low, high;
};

// The median of `count` samples (at least 1; sorted in place) and the interval that holds the true
// median with at least 95 % confidence, by order statistics: exact for any distribution of
// independent samples (the sign test's interval). Below 6 samples no such interval exists, and it
// is the samples' range.
struct rg_interval rg_median(double *samples, int count);

// The slope of the least-squares line through (x, y). At least two different x.
double rg_slope(const double *x, const double *y, int count);

// The slope and its interval of 95 % by Student's t, as if the points scattered about a line alike
// and independently. All NAN where no two x differ or one is NAN; no interval below three points.
struct rg_interval rg_slope_interval(const double *x, const double *y, int count);

#endif
