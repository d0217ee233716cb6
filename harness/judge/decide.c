#include "harness/judge/decide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/stats.h"
#include "harness/judge/deciding.h"

// Launches are averaged in pairs, and pairs in pairs again, if their lag-1 autocorrelation exceeds
// two bounds: this one, and the one that independent launches exceed by chance in one of twenty
// cases.
#define CORRELATED 0.2
#define NORMAL_95  1.645 // the normal distribution's quantile of 0.95
// Fewer launches cannot show their autocorrelation.
enum { LEAST_CORRELATED = 8 };
// If more than this share of launches sees no difference at all, the timer is coarse.
#define COARSE 0.05
// For a normal distribution: the standard deviation by the median absolute deviation.
#define DEVIATION_OF_MAD 1.4826

const char *rg_two_name(enum rg_verdict_of_two verdict)
{
    static const char *const names[] = {"inconclusive", "pass", "regressed", "improved"};
    return names[verdict];
}

struct rg_gate_rule rg_gate_rule_of(int rows)
{
    return (struct rg_gate_rule){.margin = 0.05,
                                 .error = 0.01,
                                 .rows = rows,
                                 .look_count = 5,
                                 .looks = {16, 32, 64, 128, 256}};
}

struct rg_gate_rule rg_gate_rule_apart(int rows)
{
    return (struct rg_gate_rule){.is_apart = true,
                                 .margin = 0.1,
                                 .error = 0.01,
                                 .rows = rows,
                                 .look_count = 3,
                                 .looks = {8, 16, 32}};
}

double rg_block_log_ratio(const double a_ms[2], const double b_ms[2])
{
    return (log(b_ms[0]) + log(b_ms[1]) - log(a_ms[0]) - log(a_ms[1])) / 2;
}

// --- the normal distribution ---

static double above(double x)
{
    return erfc(x / sqrt(2)) / 2;
}

// By bisection.
double rg_gate_upper_quantile(double probability)
{
    double low = 0, high = 40;
    for (int i = 0; i < 100; i++) {
        const double middle = (low + high) / 2;
        *(above(middle) > probability ? &low : &high) = middle;
    }
    return low;
}

// --- launches ---

static double lag1_autocorrelation(const double *logs, int count)
{
    double mean = 0, variance = 0, covariance = 0;
    for (int i = 0; i < count; i++)
        mean += logs[i] / count;
    for (int i = 0; i < count; i++)
        variance += (logs[i] - mean) * (logs[i] - mean);
    for (int i = 1; i < count; i++)
        covariance += (logs[i] - mean) * (logs[i - 1] - mean);
    return variance > 0 ? covariance / variance : 0;
}

int rg_gate_group(double *logs, int count)
{
    while (count >= LEAST_CORRELATED &&
           lag1_autocorrelation(logs, count) > fmax(CORRELATED, NORMAL_95 / sqrt(count))) {
        count /= 2;
        for (int i = 0; i < count; i++)
            logs[i] = (logs[2 * i] + logs[2 * i + 1]) / 2;
    }
    return count;
}

double rg_gate_spread(const double *sorted, int count, double median)
{
    double away[RG_GATE_UNITS];
    for (int i = 0; i < count; i++)
        away[i] = fabs(sorted[i] - median);
    return DEVIATION_OF_MAD * rg_median_at(away, count, 0).median;
}

// The median of the means of all pairs, each launch with itself too (Hodges and Lehmann). At most
// 64 launches, evenly chosen, are enough for it.
static double shift_of(const double *sorted, int count)
{
    enum { MOST = 64 };
    static double means[MOST * (MOST + 1) / 2];
    const int taken = count < MOST ? count : MOST;
    int pairs = 0;
    for (int i = 0; i < taken; i++)
        for (int j = i; j < taken; j++)
            means[pairs++] =
                (sorted[(long)i * count / taken] + sorted[(long)j * count / taken]) / 2;
    rg_sort(means, pairs);
    return (means[(pairs - 1) / 2] + means[pairs / 2]) / 2;
}

static bool is_coarse(const double *logs, int count)
{
    int ties = 0;
    for (int i = 0; i < count; i++)
        ties += logs[i] == 0;
    return ties > COARSE * count;
}

// --- deciding ---

double rg_gate_tail(const struct rg_gate_rule *rule)
{
    return rule->error / rule->rows / rule->look_count / 2;
}

// The log ratio that the interval must exclude; `worth` is the one that the median must exceed.
static double excluded(const struct rg_gate_rule *rule)
{
    return rule->is_apart ? log1p(rule->margin / 2) : 0;
}

static double worth(const struct rg_gate_rule *rule)
{
    return log1p(rule->is_apart ? rule->margin : rule->margin / 2);
}

static enum rg_verdict_of_two judge(const struct rg_gate_rule *rule, double median, double low,
                                    double high)
{
    const double margin = log1p(rule->margin);
    if (low > excluded(rule) && median > worth(rule))
        return RG_TWO_REGRESSED;
    if (high < -excluded(rule) && median < -worth(rule))
        return RG_TWO_IMPROVED;
    return low > -margin && high < margin ? RG_TWO_PASS : RG_TWO_INCONCLUSIVE;
}

// The smallest log ratio that gets a verdict: its interval excludes `excluded`, and its median
// exceeds `worth`. `quantile` belongs to the probability with which it is noticed.
static double seen_from(const struct rg_gate_rule *rule, double error, double quantile)
{
    const double by_interval =
        excluded(rule) + (rg_gate_upper_quantile(rg_gate_tail(rule)) + quantile) * error;
    const double by_worth = worth(rule) + quantile * error;
    return fmax(by_interval, by_worth);
}

void rg_gate_conclude(const struct rg_gate_rule *rule, const struct rg_interval *of,
                      struct rg_gate_decision *d)
{
    d->ratio = exp(of->median);
    if (isnan(of->low)) // too few launches for an interval
        return;
    d->smallest = expm1(seen_from(rule, d->error, rg_gate_upper_quantile(0.05)));
    d->low = exp(of->low);
    d->high = exp(of->high);
    if (!d->is_coarse)
        d->verdict = judge(rule, of->median, of->low, of->high);
}

struct rg_gate_decision rg_gate_decide(const struct rg_gate_rule *rule, const double *logs,
                                       int count)
{
    double sorted[RG_GATE_UNITS];
    struct rg_gate_decision d = {.ratio = 1, .high = INFINITY, .shift = 1, .smallest = INFINITY};
    const int taken = count < RG_GATE_UNITS ? count : RG_GATE_UNITS;
    if (taken < 1)
        return d;
    memcpy(sorted, logs, (size_t)taken * sizeof(*sorted));
    d.is_coarse = is_coarse(logs, taken);
    d.units = rg_gate_group(sorted, taken);
    d.is_grouped = d.units < taken;
    const struct rg_interval median = rg_median_at(sorted, d.units, rg_gate_tail(rule));
    d.shift = exp(shift_of(sorted, d.units));
    d.spread = rg_gate_spread(sorted, d.units, median.median);
    d.error = RG_GATE_SQRT_HALF_PI * d.spread / sqrt(d.units);
    rg_gate_conclude(rule, &median, &d);
    return d;
}

double rg_gate_power(const struct rg_gate_rule *rule, const struct rg_gate_decision *d,
                     double change)
{
    const double error = d->error, least = seen_from(rule, error, 0);
    if (!isfinite(d->smallest))
        return 0;
    if (!(error > 0))
        return log1p(change) > least;
    return above((least - log1p(change)) / error);
}
