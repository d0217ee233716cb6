// By how much one sample lies above another that was taken apart from it.
#ifndef RG_HARNESS_RECORD_SHIFT_H
#define RG_HARNESS_RECORD_SHIFT_H

#include "harness/record/stats.h"

enum { RG_SHIFT_SAMPLES = 64 };

// Hodges' and Lehmann's estimate of b - a, the median of the differences of all pairs, and the
// interval that the true shift is below, and above, with a probability of at most `tail` each, by
// Mann's and Whitney's distribution: exact for independent samples of distributions that differ in
// nothing but the shift, whatever they are. Both counts are 1 to RG_SHIFT_SAMPLES. The ends are NAN
// where so few samples have no such interval.
struct rg_interval rg_shift(const double *a, int a_count, const double *b, int b_count,
                            double tail);

#endif
