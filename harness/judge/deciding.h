// Shared by both ways of deciding; for this folder's files alone.
#ifndef RG_HARNESS_JUDGE_DECIDING_H
#define RG_HARNESS_JUDGE_DECIDING_H

#include "harness/judge/decide.h"

// Averages pairs until neighbours are no longer correlated; an odd one at the end is dropped.
// Returns how many are left.
int rg_gate_group(double *logs, int count);

// The standard deviation of launches, estimated by their median absolute deviation.
double rg_gate_spread(const double *sorted, int count, double median);

// For a normal distribution: the median's standard error by the mean's, sqrt(pi / 2).
#define RG_GATE_SQRT_HALF_PI 1.2533
// The quantile that a standard normal variable exceeds with this probability.
double rg_gate_upper_quantile(double probability);

// The error probability of each end of a look's interval.
double rg_gate_tail(const struct rg_gate_rule *rule);

// Fills in ratio, interval, smallest and verdict. They follow from the interval of a logarithm,
// whose ends are NAN if there is none, and from the decision's error.
void rg_gate_conclude(const struct rg_gate_rule *rule, const struct rg_interval *of,
                      struct rg_gate_decision *decision);

#endif
