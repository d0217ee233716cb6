#include "core/base/stats.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// The largest k with P(X < k) <= tail for X of `count` fair coins; 0 when there is none.
static int outer_rank(int count, double tail)
{
    double probability = pow(0.5, count), below = 0;
    int k = 0;
    while (below + probability <= tail) {
        below += probability;
        probability *= (double)(count - k) / (k + 1);
        k++;
    }
    return k;
}

void rg_sort(double *samples, int count)
{
    qsort(samples, (size_t)count, sizeof(*samples), ascending);
}

struct rg_interval rg_median(double *samples, int count)
{
    return rg_median_at(samples, count, 0.025);
}

struct rg_interval rg_median_at(double *samples, int count, double tail)
{
    rg_sort(samples, count);
    return rg_median_sorted(samples, count, tail);
}

struct rg_interval rg_median_of_launches(double *times, int count)
{
    // Student's t with 1 to 4 degrees of freedom: 2.5 % of its values are greater.
    static const double quantiles[RG_LEAST_SAMPLES] = {[2] = 12.7062, 4.30265, 3.18245, 2.77645};
    struct rg_interval interval = rg_median(times, count);
    double mean = 0, squares = 0;
    if (count < 2 || count >= RG_LEAST_SAMPLES)
        return interval;
    for (int i = 0; i < count; i++)
        mean += log(times[i]) / count;
    for (int i = 0; i < count; i++)
        squares += pow(log(times[i]) - mean, 2);
    const double half = quantiles[count] * sqrt(squares / (count - 1) / count);
    interval.low = exp(mean - half);
    interval.high = exp(mean + half);
    return interval;
}

struct rg_interval rg_median_sorted(const double *sorted, int count, double tail)
{
    const int k = outer_rank(count, tail);
    return (struct rg_interval){
        .median = (sorted[(count - 1) / 2] + sorted[count / 2]) / 2,
        .low = k ? sorted[k - 1] : NAN,
        .high = k ? sorted[count - k] : NAN,
    };
}
