// The course of a gate: which launch times which rows in which order, when a verdict is sought, and
// when it ends. It calls for times and reads no clock, so that stored times can take its place.
#ifndef RG_HARNESS_COMPARE_GATE_DECIDE_COURSE_H
#define RG_HARNESS_COMPARE_GATE_DECIDE_COURSE_H

#include <stdint.h>

#include "harness/compare/gate/decide/decide.h"
#include "harness/record/stats.h"

// What a launch tells of a row.
struct rg_quads {
    double log;        // rg_block_log_ratio of its quad; of several, the median
    double a_ms, b_ms; // a frame, in median
    bool is_disturbed; // others took the processors meanwhile: it does not count, whatever it says
};

// What gives times. Each returns false where nothing more can be had: `launch` for all rows, and
// `take` for this one.
struct rg_quad_source {
    // Starts both anew. `number` counts from 0.
    bool (*launch)(int number, void *user);
    // Takes quads of a row: A B B A, or B A A B where `b_first`, and by turns where they are
    // several.
    bool (*take)(int row, bool b_first, struct rg_quads *quads, void *user);
    // Whether no launch is to be begun any more: the time is over, or the user ends it. It must not
    // follow from the times, which would be peeking. NULL: never.
    bool (*is_over)(void *user);
    void *user;
    // Of each row, A's times that were taken earlier: then `take` takes B's alone, once, whatever
    // b_first says, and the log is that of its time. NULL: both are taken in turn.
    const struct rg_gate_sample *before;
};

// Why a row has no other verdict than inconclusive.
enum rg_course_end {
    RG_END_DECIDED,
    RG_END_LOOKS,       // there is no other look
    RG_END_OVER,        // is_over
    RG_END_DISTURBED,   // of four launches three did not count
    RG_END_BROKEN,      // the source gave no more of it
    RG_END_UNCONFIRMED, // it was not the same when it was measured again
};

struct rg_gate_row {
    // The verdict that counts. One that is not pass was found twice, by launches of its own each;
    // the second is here, and the first in `before`.
    struct rg_gate_decision decision, before;
    enum rg_course_end end;
    int launches, disturbed;       // that were taken, and of these did not count
    struct rg_interval a_ms, b_ms; // of all times that count, with 95 %; medians 0: there are none
};

// Whether B comes first is drawn by this seed; so is the order of the rows in a launch.
#define RG_COURSE_SEED 0x726761u

// Runs it for rule->rows rows. False, and one logged line, without memory.
bool rg_course_run(const struct rg_gate_rule *rule, const struct rg_quad_source *source,
                   uint32_t seed, struct rg_gate_row *rows);

#endif
