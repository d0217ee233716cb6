// Medians with confidence intervals.
#ifndef RG_CORE_BASE_STATS_H
#define RG_CORE_BASE_STATS_H

// With fewer samples a median has no 95 % interval.
enum { RG_LEAST_SAMPLES = 6 };

struct rg_interval {
    double median, low, high;
};

// Sorts samples, the smallest first.
void rg_sort(double *samples, int count);

// The median of `count` samples (at least 1; sorted in place), and an interval that contains the
// true median with at least 95 % confidence. The interval is that of the sign test, by order
// statistics, and is exact for independent samples of any distribution. With fewer than
// RG_LEAST_SAMPLES there is none, and its ends are NAN.
struct rg_interval rg_median(double *samples, int count);
// The same with another interval: the true median is below it, and above it, with a probability of
// at most `tail` each. Its ends are NAN if the samples are too few.
struct rg_interval rg_median_at(double *samples, int count, double tail);
// The same for times above 0 of so few launches that the sign test gives no interval: with 2 to 5
// the interval is Student's for the mean of their logarithms. With one its ends are NAN.
struct rg_interval rg_median_of_launches(double *times, int count);
// The same as rg_median_at for samples that are sorted already.
struct rg_interval rg_median_sorted(const double *sorted, int count, double tail);

#endif
