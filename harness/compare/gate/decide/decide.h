// Whether one of two things takes longer than the other, from times that were taken in turn.
//
// The unit of all of it is a launch: both are started anew, and give a quad, four times in the
// order ABBA or BAAB, of which one number follows (rg_block_log_ratio). Launches differ by more
// than the times of one, for where a process lies in memory counts: so they are what is counted.
//
// The interval is the sign test's, exact whatever the distribution. A verdict needs both: that the
// interval excludes no change, and that the change is worth a word. Nothing here reads a clock.
//
// Where A's times were taken apart from B's, earlier, there are no quads: each launch of either
// gives one number, the logarithm of a time, and the interval is Mann's and Whitney's
// (record/shift.h).
#ifndef RG_HARNESS_COMPARE_GATE_DECIDE_DECIDE_H
#define RG_HARNESS_COMPARE_GATE_DECIDE_DECIDE_H

#include <stdbool.h>

#include "harness/record/shift.h"

enum rg_verdict_of_two {
    RG_TWO_INCONCLUSIVE, // more launches would tell
    RG_TWO_PASS,         // neither takes longer by the margin
    RG_TWO_REGRESSED,    // B takes longer, by more than half of the margin at least
    RG_TWO_IMPROVED,     // A does
};
// "pass"
const char *rg_two_name(enum rg_verdict_of_two verdict);

enum { RG_GATE_LOOKS = 6, RG_GATE_UNITS = 1024 };

// How is decided: settled before the first time is taken.
struct rg_gate_rule {
    // A's times were taken apart, in another run. Runs differ by more than their launches tell, and
    // no interval has that: so the interval must exclude half of the margin, and not only no
    // change, and the change itself be above all of the margin.
    bool is_apart;
    double margin; // above 0: 0.05 for 5 %; INFINITY: no change is worth a word
    double error;  // the probability that any of all rows, of two that are the same, gets another
                   // verdict than pass or inconclusive; rows and looks share it
    int rows;
    int look_count;
    int looks[RG_GATE_LOOKS]; // rising: after so many launches a verdict is sought
};
// The project's own, for so many rows: 5 %, 1 %, and looks after 16, 32, 64, 128 and 256 launches.
struct rg_gate_rule rg_gate_rule_of(int rows);
// The same for times that were taken apart: 10 %, 1 %, and looks after 8, 16 and 32 launches.
struct rg_gate_rule rg_gate_rule_apart(int rows);

// By how much B's times are above A's in a quad, as a logarithm of their ratio: what rises or falls
// steadily over the quad is not in it.
double rg_block_log_ratio(const double a_ms[2], const double b_ms[2]);

// What launches tell of a row. Ratios are B's time by A's.
struct rg_gate_decision {
    enum rg_verdict_of_two verdict;
    double ratio, low, high; // the median, and the look's interval: 0 and INFINITY without one
    double shift;            // Hodges' and Lehmann's estimate of the ratio, which is told beside it
    double smallest;         // the smallest change that would have been seen with 95 %: 0.02 is 2 %
    double spread;           // of a launch: the standard deviation of its logarithm, robustly
    double error;            // of the ratio: the standard deviation of its logarithm
    int units;               // what it rests on: launches, or groups of them
    bool is_grouped;         // launches followed each other's noise, so that groups were counted
    bool is_coarse; // more than 5 % of the launches saw no difference: the timer cannot tell
};

// Decides after the launches of a look; `logs` are rg_block_log_ratio's, in the order in which they
// were taken, at most RG_GATE_UNITS.
struct rg_gate_decision rg_gate_decide(const struct rg_gate_rule *rule, const double *logs,
                                       int count);

// A's times that were taken earlier.
struct rg_gate_sample {
    int count;                     // launches that count, at least 1
    double logs[RG_SHIFT_SAMPLES]; // of a frame's time, in the order in which they were taken
};
// The same of launches of B alone, at most RG_SHIFT_SAMPLES, whose times have these logarithms. The
// ratio is `shift`; `spread` is that of the sample that scatters more; `units` are B's.
struct rg_gate_decision rg_gate_decide_apart(const struct rg_gate_rule *rule,
                                             const struct rg_gate_sample *a, const double *logs,
                                             int count);

// The probability that a change is seen, by the launches' spread: 0.05 for 5 %.
double rg_gate_power(const struct rg_gate_rule *rule, const struct rg_gate_decision *decision,
                     double change);

#endif
