// Decides from two samples that were taken at different times.
#include <math.h>
#include <string.h>

#include "harness/judge/deciding.h"

// The factor from the standard error of a difference of means to that of Hodges and Lehmann's
// estimate, for normal noise: the root of the estimate's efficiency, 3 / pi.
#define OF_SHIFT 0.9772

// A sample's launches, or means of groups of them, sorted.
struct units {
    int count;
    double logs[RG_SHIFT_SAMPLES];
    double spread;
};

static struct units units_of(const double *logs, int count)
{
    struct units units = {.count = count < RG_SHIFT_SAMPLES ? count : RG_SHIFT_SAMPLES};
    memcpy(units.logs, logs, (size_t)units.count * sizeof(*logs));
    units.count = rg_gate_group(units.logs, units.count);
    const double median = rg_median_at(units.logs, units.count, 0).median;
    units.spread = rg_gate_spread(units.logs, units.count, median);
    return units;
}

struct rg_gate_decision rg_gate_decide_apart(const struct rg_gate_rule *rule,
                                             const struct rg_gate_sample *before,
                                             const double *logs, int count)
{
    struct rg_gate_decision d = {.ratio = 1, .high = INFINITY, .shift = 1, .smallest = INFINITY};
    if (count < 1 || before->count < 1)
        return d;
    const struct units a = units_of(before->logs, before->count), b = units_of(logs, count);
    const struct rg_interval shift = rg_shift(a.logs, a.count, b.logs, b.count, rg_gate_tail(rule));
    d.units = b.count;
    d.is_grouped = a.count < before->count || b.count < count;
    d.shift = exp(shift.median);
    d.spread = fmax(a.spread, b.spread);
    d.error = sqrt(a.spread * a.spread / a.count + b.spread * b.spread / b.count) / OF_SHIFT;
    rg_gate_conclude(rule, &shift, &d);
    return d;
}
