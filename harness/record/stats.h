// Medians and their intervals.
#ifndef RG_HARNESS_RECORD_STATS_H
#define RG_HARNESS_RECORD_STATS_H

// Of fewer samples a median has no interval of 95 %.
enum { RG_LEAST_SAMPLES = 6 };

struct rg_interval {
    double median, low, high;
};

// The median of `count` samples (at least 1; sorted in place) and the interval that holds the true
// median with at least 95 % confidence, by order statistics: exact for any distribution of
// independent samples (the sign test's interval). Of fewer than RG_LEAST_SAMPLES no such interval
// exists, and its ends are NAN.
struct rg_interval rg_median(double *samples, int count);
// The same with an interval that the true median is below, and above, with a probability of at most
// `tail` each; its ends are NAN where so few samples have none.
struct rg_interval rg_median_at(double *samples, int count, double tail);

#endif
