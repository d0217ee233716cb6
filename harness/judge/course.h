// The course of a gate: which launch times which rows in which order, when a verdict is sought, and
// when the gate ends. It asks for times and reads no clock, so stored times can replace new ones.
#ifndef RG_HARNESS_JUDGE_COURSE_H
#define RG_HARNESS_JUDGE_COURSE_H

#include <stdint.h>

#include "core/base/stats.h"
#include "harness/judge/decide.h"

// A launch's result for a row.
struct rg_quads {
    double log;        // rg_block_log_ratio of its block; the median if there are several
    double a_ms, b_ms; // of a frame; medians
    bool is_disturbed; // others used the processors meanwhile, so it does not count
};

// Supplies times. Each function returns false if it can supply no more: `launch` for all rows,
// `take` for this row.
struct rg_quad_source {
    // Starts both sides anew. `number` counts from 0.
    bool (*launch)(int number, void *user);
    // Takes blocks of a row: ABBA, or BAAB if `b_first`; several blocks alternate.
    bool (*take)(int row, bool b_first, struct rg_quads *quads, void *user);
    // Whether no launch may begin any more, because time is over or the user ends it. It must not
    // depend on the times, which would be peeking. NULL: never.
    bool (*is_over)(void *user);
    void *user;
    // A's times of each row, if they were taken earlier. `take` then takes one time of B, whatever
    // b_first says, and the log is the logarithm of that time. NULL: both sides are timed in turn.
    const struct rg_gate_sample *before;
};

// How a row's course ended, and so why it may be inconclusive.
enum rg_course_end {
    RG_END_DECIDED,
    RG_END_LOOKS,       // no look is left
    RG_END_OVER,        // is_over
    RG_END_DISTURBED,   // three of four launches did not count
    RG_END_BROKEN,      // the source had no more times for the row
    RG_END_UNCONFIRMED, // the second measurement gave another verdict
};

struct rg_gate_row {
    // The verdict that counts. A verdict other than pass is found twice, by separate launches; the
    // second is here, the first in `before`.
    struct rg_gate_decision decision, before;
    enum rg_course_end end;
    int launches, disturbed;       // launches taken, and how many of these did not count
    struct rg_interval a_ms, b_ms; // of all times that count, 95 %; medians 0: there are none
};

// Seed of the draws: the order of the rows in a launch, and whether B comes first.
#define RG_COURSE_SEED 0x726761u

// Runs the course for rule->rows rows. False, and one logged line, without memory.
bool rg_course_run(const struct rg_gate_rule *rule, const struct rg_quad_source *source,
                   uint32_t seed, struct rg_gate_row *rows);

#endif
