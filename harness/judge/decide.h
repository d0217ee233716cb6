// Decides whether one of two sides takes longer than the other, from times that were taken in turn.
//
// The unit is a launch: both sides are started anew and timed in an ABBA block, four times in the
// order ABBA or BAAB. The block gives one number (rg_block_log_ratio). Launches differ more than
// the times within one, for instance by where a process lies in memory, so launches are counted.
//
// The interval is that of the sign test, which is exact for any distribution. A verdict needs both:
// the interval excludes no change, and the change matters. Nothing here reads a clock.
//
// If A's times were taken earlier, there are no blocks. Each launch of a side then gives the
// logarithm of a time, and the interval is Mann's and Whitney's (judge/shift.h).
#ifndef RG_HARNESS_JUDGE_DECIDE_H
#define RG_HARNESS_JUDGE_DECIDE_H

#include <stdbool.h>

#include "harness/judge/shift.h"

enum rg_verdict_of_two {
    RG_TWO_INCONCLUSIVE, // more launches could decide
    RG_TWO_PASS,         // neither side takes longer by the margin
    RG_TWO_REGRESSED,    // B takes longer, by more than half of the margin at least
    RG_TWO_IMPROVED,     // A takes longer, likewise
};
// "pass"
const char *rg_two_name(enum rg_verdict_of_two verdict);

enum { RG_GATE_LOOKS = 6, RG_GATE_UNITS = 1024 };

// How to decide; fixed before the first time is taken.
struct rg_gate_rule {
    // A's times were taken in another run. Runs differ by more than their launches show, and no
    // interval covers this. So the interval must exclude half of the margin, not only no change,
    // and the change itself must exceed the whole margin.
    bool is_apart;
    double margin; // above 0: 0.05 for 5 %; INFINITY: no change matters
    double error;  // probability that any row of identical sides gets a verdict other than pass or
                   // inconclusive; rows and looks share it
    int rows;
    int look_count;
    int looks[RG_GATE_LOOKS]; // rising: numbers of launches after which a verdict is sought
};
// The project's rule for so many rows: 5 %, 1 %, and looks after 16, 32, 64, 128 and 256 launches.
struct rg_gate_rule rg_gate_rule_of(int rows);
// The same for times taken in another run: 10 %, 1 %, and looks after 8, 16 and 32 launches.
struct rg_gate_rule rg_gate_rule_apart(int rows);

// The logarithm of B's time by A's over an ABBA block. A steady drift over the block cancels.
double rg_block_log_ratio(const double a_ms[2], const double b_ms[2]);

// The decision on a row after some launches. Ratios are B's time by A's.
struct rg_gate_decision {
    enum rg_verdict_of_two verdict;
    double ratio, low, high; // the median, and the look's interval: 0 and INFINITY without one
    double shift;            // Hodges' and Lehmann's estimate of the ratio, for the report
    double smallest;         // smallest change that would have been noticed with 95 %: 0.02 is 2 %
    double spread;           // robust standard deviation of a launch's logarithm
    double error;            // standard deviation of the ratio's logarithm
    int units;               // number of launches, or groups of them, that it rests on
    bool is_grouped;         // launches were correlated, so that groups were counted
    bool is_coarse; // more than 5 % of the launches saw no difference: the timer cannot tell
};

// Decides after the launches of a look. `logs` are rg_block_log_ratio's, in the order in which they
// were taken, at most RG_GATE_UNITS.
struct rg_gate_decision rg_gate_decide(const struct rg_gate_rule *rule, const double *logs,
                                       int count);

// A's times, if they were taken earlier.
struct rg_gate_sample {
    int count;                     // launches that count, at least 1
    double logs[RG_SHIFT_SAMPLES]; // logarithms of a frame's time, in the order in which they were
                                   // taken
};
// The same for launches of B alone, at most RG_SHIFT_SAMPLES; `logs` are the logarithms of their
// times. The ratio is `shift`; `spread` is that of the sample that scatters more; `units` are B's.
struct rg_gate_decision rg_gate_decide_apart(const struct rg_gate_rule *rule,
                                             const struct rg_gate_sample *a, const double *logs,
                                             int count);

// The probability that a change, 0.05 for 5 %, is noticed, given the launches' spread.
double rg_gate_power(const struct rg_gate_rule *rule, const struct rg_gate_decision *decision,
                     double change);

#endif
