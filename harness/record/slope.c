#include "harness/record/slope.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/dialect/rng.h"

// OUTSIDE: resampled slopes beyond either end of the interval, 2.5 %.
enum { RESAMPLES = 2000, OUTSIDE = RESAMPLES / 40 };

static double group_mean(const struct rg_slope_point *points, int count, int group)
{
    double sum = 0;
    int members = 0;
    for (int i = 0; i < count; i++) {
        if (points[i].group != group)
            continue;
        sum += points[i].x;
        members++;
    }
    return sum / members;
}

void rg_slope_weights(const struct rg_slope_point *points, int count, double *weights)
{
    double squares = 0;
    for (int i = 0; i < count; i++) {
        weights[i] = points[i].x - group_mean(points, count, points[i].group);
        squares += weights[i] * weights[i];
    }
    for (int i = 0; i < count; i++)
        weights[i] = squares > 0 ? weights[i] / squares : NAN;
}

// --- resampling ---

static double median_of(const double *sorted, int count)
{
    return (sorted[(count - 1) / 2] + sorted[count / 2]) / 2;
}

// Draws `count` times with replacement; `times` gets how often each sample was drawn.
static void draw(int count, int point, int round, int *times)
{
    memset(times, 0, (size_t)count * sizeof(*times));
    for (int i = 0; i < count; i += 4) {
        const rg_uint4 bits = rg_random(2, (uint)point, (uint)round, (uint)i);
        const uint four[] = {bits.x, bits.y, bits.z, bits.w};
        for (int j = 0; j < 4 && i + j < count; j++)
            times[(uint64_t)four[j] * (uint64_t)count >> 32]++;
    }
}

// The value of rank `rank`, from 0, among the drawn samples.
static double drawn_at(const double *sorted, const int *times, int rank)
{
    int i = 0;
    for (int below = times[0]; below <= rank; below += times[i])
        i++;
    return sorted[i];
}

static double median_drawn(const double *sorted, int count, int point, int round)
{
    int times[RG_SLOPE_SAMPLES];
    draw(count, point, round, times);
    return (drawn_at(sorted, times, (count - 1) / 2) + drawn_at(sorted, times, count / 2)) / 2;
}

// Adds a point's contribution to the slope, and to each resampled slope.
static void add_point(const struct rg_slope_point *point, int index, double weight, double *slope,
                      double drawn[RESAMPLES])
{
    double sorted[RG_SLOPE_SAMPLES];
    memcpy(sorted, point->samples, (size_t)point->count * sizeof(*sorted));
    rg_sort(sorted, point->count);
    *slope += weight * log(median_of(sorted, point->count));
    for (int round = 0; round < RESAMPLES; round++)
        drawn[round] += weight * log(median_drawn(sorted, point->count, index, round));
}

// The slope that drift of the machine along the axis may contribute.
static double slope_of_loads(const struct rg_slope_point *points, int count, const double *weights)
{
    double slope = 0;
    for (int i = 0; i < count; i++) {
        if (!(points[i].load_ms > 0))
            return 0;
        slope += weights[i] * log(points[i].load_ms);
    }
    return fabs(slope);
}

struct rg_interval rg_slope_resampled(const struct rg_slope_point *points, int count)
{
    double weights[RG_SLOPE_POINTS], drawn[RESAMPLES] = {0}, slope = 0;
    int fewest = RG_SLOPE_SAMPLES;
    rg_slope_weights(points, count, weights);
    for (int i = 0; i < count; i++) {
        add_point(&points[i], i, weights[i], &slope, drawn);
        fewest = points[i].count < fewest ? points[i].count : fewest;
    }
    if (!count || fewest < RG_LEAST_SAMPLES || !isfinite(slope))
        return (struct rg_interval){count && isfinite(slope) ? slope : NAN, NAN, NAN};
    rg_sort(drawn, RESAMPLES);
    const double drift = slope_of_loads(points, count, weights);
    return (struct rg_interval){slope, drawn[OUTSIDE] - drift,
                                drawn[RESAMPLES - 1 - OUTSIDE] + drift};
}
