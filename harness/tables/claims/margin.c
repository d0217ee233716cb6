#include "harness/tables/claims/margin.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Quantiles of the normal distribution, in standard deviations: half of it is within the first, 95
// % within the second.
#define HALF_WITHIN 0.6745
#define MOST_WITHIN 1.96

double rg_margin_rounding(double printed)
{
    char text[32];
    snprintf(text, sizeof(text), "%.7g", printed);
    const char *point = strchr(text, '.');
    const int decimals = point ? (int)strlen(point + 1) : 0;
    return isfinite(printed) && printed > 0 ? 0.5 * pow(10, -decimals) / printed : 0;
}

bool rg_margin_orders(double larger, double smaller)
{
    return larger * (1 - rg_margin_rounding(larger)) > smaller * (1 + rg_margin_rounding(smaller));
}

// The distance of a row's logarithm from the line between its neighbours, scaled as if only that
// row had an error of one standard deviation. False unless it is between two rows of its group.
static bool is_off(const struct rg_slope_point *p, const double *printed, int count, int i,
                   double *off)
{
    if (i < 1 || i + 1 >= count || p[i - 1].group != p[i].group || p[i + 1].group != p[i].group)
        return false;
    const double t = (p[i].x - p[i - 1].x) / (p[i + 1].x - p[i - 1].x);
    const double line = (1 - t) * log(printed[i - 1]) + t * log(printed[i + 1]);
    *off = fabs(log(printed[i]) - line) / sqrt(1 + (1 - t) * (1 - t) + t * t);
    return isfinite(*off);
}

// The standard deviation of printed rows from their neighbours. It uses the median deviation, which
// a single bend of the curve does not affect; 0 for fewer than three rows.
static double scatter(const struct rg_slope_point *points, const double *printed, int count)
{
    double offs[RG_SLOPE_POINTS];
    int found = 0;
    for (int i = 0; i < count; i++)
        found += is_off(points, printed, count, i, &offs[found]);
    if (!found)
        return 0;
    rg_sort(offs, found);
    return (offs[(found - 1) / 2] + offs[found / 2]) / 2 / HALF_WITHIN;
}

double rg_margin_slope(const struct rg_slope_point *points, const double *weights,
                       const double *printed, int count)
{
    const double sigma = scatter(points, printed, count);
    double variance = 0;
    for (int i = 0; i < count; i++) {
        const double half = rg_margin_rounding(printed[i]); // uniform: a third of its square
        variance += weights[i] * weights[i] * (sigma * sigma + half * half / 3);
    }
    return MOST_WITHIN * sqrt(variance);
}
