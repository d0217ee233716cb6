// A gate while it runs. Only files of this folder include it.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_RUNNING_H
#define RG_HARNESS_COMPARE_GATE_RUN_RUNNING_H

#include "harness/compare/gate/run/gate.h"

enum { RG_GATE_MOST_SIDES = RG_SIDES * RG_MAX_DEVICES };

struct rg_running_gate {
    const struct rg_gate_request *asked;
    struct rg_gate *gate;       // one case per cell that the filter selects
    int family[RG_MAX_DEVICES]; // of each course: the cells that all shards may time
    // The sides of the pairs, two by two, A first. With a baseline A has no name.
    int side_count;
    struct rg_side sides[RG_GATE_MOST_SIDES];
    json_t *passport; // of the sides that are present
    struct rg_truth truth;
    struct rg_launches yardsticks[RG_YARDSTICKS];
    double start_ms, end_ms;         // of the pair that runs; end 0: no limit
    double first_ms;                 // when the first pair began
    double look_ms;                  // until a pair's first look, the longest of all pairs
    bool has_looked;                 // some case reached its first look, or ended without it
    struct rg_gate_journal *journal; // NULL: no journal
};

// --- choose.c ---

// Adds the cases that the filter selects and that the shard has, whose sides are those of all
// pairs. Shards divide cases by the time that they are expected to take: that of the baseline, or
// of the request's times. False, and one logged line, without memory.
bool rg_gate_choose(struct rg_running_gate *run);

// --- agree.c ---

// Runs a case's cell on its open sides and compares them: the picture by the tier that the two owe
// each other, states bit for bit if that is T0, counters and a frame's work exactly. A baseline has
// a digest in place of a picture; if it differs, cpu:reference draws the true picture now.
//
// Fills in the agreement; if the case agrees, its message holds remarks. Pictures that differ are
// written into `folder` under the case's name (harness/compare/gate/pictures/); NULL: none are.
void rg_gate_agree(struct rg_gate_case *of, struct rg_truth *truth, const char *folder);

// Ends a case with the last error, because its side could not be launched.
void rg_gate_agree_fails(struct rg_gate_case *of, const char *device);

// Adds a frame's time compared with a baseline of another comparison key. Yardsticks, which took
// `then` and take `now` (RG_YARDSTICKS of each), make the times comparable. This is advice and
// fails nothing.
void rg_gate_advise(const struct rg_gate_row *row, const struct rg_timed_cell *timed,
                    const struct rg_launches *then, const struct rg_launches *now,
                    struct rg_agreement *agreement);

// --- timing.c ---

// How many courses share the budget and the error: one with a baseline.
int rg_gate_courses(const struct rg_running_gate *run);
// Whether the time of the pair that runs is over.
bool rg_gate_is_over(const struct rg_running_gate *run);
// The rule for `count` cells of a course that are timed. Shards share the error of all cells that
// any of them may time. Advice takes one look, and no change matters to it: it is reported and
// decides nothing.
struct rg_gate_rule rg_gate_rule_in(const struct rg_running_gate *run, int course, int count,
                                    bool is_advice);
// Times the cases of a pair, or all that run alone, and notes when a first look was due.
bool rg_gate_time(struct rg_running_gate *run, struct rg_gate_case *cases, int count);

// --- fixed.c ---

// Draws the fixed functions of each device whose case is chosen, and holds them against the digests
// in a baseline, or against another driver's. Adds to the report: a case for all of a device's, and
// one for each whose digest is another or that an expectation names. They are not compared, and
// their case is skipped, where processor, vector width or settings, on which bits may depend, are
// others. Two drivers' pictures may differ as the APIs allow: such a case passes, and says so,
// unless the gate is strict. Call it after rg_gate_report. False, and one logged line, without
// memory.
bool rg_gate_hold_fixed(struct rg_running_gate *run);

#endif
