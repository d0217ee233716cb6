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

// Student's t that 2.5 % exceed. Beyond the table its last value, which is a little too large.
static double student(int freedom)
{
    static const double t[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306,
                               2.262,  2.228, 2.201, 2.179, 2.160, 2.145, 2.131, 2.120,
                               2.110,  2.101, 2.093, 2.086, 2.080, 2.074, 2.069, 2.064};
    const int rows = sizeof(t) / sizeof(t[0]);
    return t[(freedom < rows ? freedom : rows) - 1];
}

struct rg_interval rg_slope_interval(const double *x, const double *y, int count)
{
    const double slope = rg_slope(x, y, count);
    double mx = 0, my = 0, xx = 0, rest = 0;
    for (int i = 0; i < count; i++) {
        mx += x[i] / count;
        my += y[i] / count;
    }
    for (int i = 0; i < count; i++) {
        const double off = y[i] - my - slope * (x[i] - mx);
        xx += (x[i] - mx) * (x[i] - mx);
        rest += off * off;
    }
    if (count < 3 || !isfinite(slope))
        return (struct rg_interval){isfinite(slope) ? slope : NAN, NAN, NAN};
    const double half = student(count - 2) * sqrt(rest / (count - 2) / xx);
    return (struct rg_interval){slope, slope - half, slope + half};
}
