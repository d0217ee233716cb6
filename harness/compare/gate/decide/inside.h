// What both ways of deciding share, for files of this folder alone.
#ifndef RG_HARNESS_COMPARE_GATE_DECIDE_INSIDE_H
#define RG_HARNESS_COMPARE_GATE_DECIDE_INSIDE_H

#include "harness/compare/gate/decide/decide.h"

// Takes the means of pairs, until those that follow each other are no longer alike. What is left
// over in the end is in none. Returns how many there are.
int rg_gate_group(double *logs, int count);

// The standard deviation of launches, by their median absolute deviation.
double rg_gate_spread(const double *sorted, int count, double median);

// What each end of a look's interval may be wrong with.
double rg_gate_tail(const struct rg_gate_rule *rule);

// Fills in ratio, interval, smallest and verdict from the interval of a logarithm, whose ends are
// NAN where there is none, and from the decision's error.
void rg_gate_conclude(const struct rg_gate_rule *rule, const struct rg_interval *of,
                      struct rg_gate_decision *decision);

#endif
