// Estimates the shift between two independent samples.
#ifndef RG_HARNESS_JUDGE_SHIFT_H
#define RG_HARNESS_JUDGE_SHIFT_H

#include "core/base/stats.h"

enum { RG_SHIFT_SAMPLES = 64 };

// Hodges and Lehmann's estimate of b - a, the median of the differences of all pairs, and its
// confidence interval by Mann and Whitney's distribution. The true shift is below the interval, and
// above it, with a probability of at most `tail` each. The interval is exact for independent
// samples of any distributions that differ only in a shift. Both counts are 1 to RG_SHIFT_SAMPLES.
// The ends are NAN if the samples are too few.
struct rg_interval rg_shift(const double *a, int a_count, const double *b, int b_count,
                            double tail);

#endif
