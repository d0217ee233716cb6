#include "harness/record/stats.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// The largest k with P(X < k) <= 0.025 for X of `count` fair coins; 0 when there is none.
static int outer_rank(int count)
{
    double probability = pow(0.5, count), below = 0;
    int k = 0;
    while (below + probability <= 0.025) {
        below += probability;
        probability *= (double)(count - k) / (k + 1);
        k++;
    }
    return k;
}

struct rg_interval rg_median(double *samples, int count)
{
    qsort(samples, (size_t)count, sizeof(*samples), ascending);
    int k = outer_rank(count);
    k = k > 0 ? k : 1;
    return (struct rg_interval){
        .median = (samples[(count - 1) / 2] + samples[count / 2]) / 2,
        .low = samples[k - 1],
        .high = samples[count - k],
    };
}

double rg_slope(const double *x, const double *y, int count)
{
    double mx = 0, my = 0, xy = 0, xx = 0;
    for (int i = 0; i < count; i++) {
        mx += x[i] / count;
        my += y[i] / count;
    }
    for (int i = 0; i < count; i++) {
        xy += (x[i] - mx) * (y[i] - my);
        xx += (x[i] - mx) * (x[i] - mx);
    }
    return xy / xx;
}
