// Times the cases of a gate that agree. Only files of this folder include it.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_TIMING_H
#define RG_HARNESS_COMPARE_GATE_RUN_TIMING_H

#include <jansson.h>

#include "harness/compare/gate/run/gate.h"

enum { RG_GATE_MOST_SIDES = RG_SIDES * RG_MAX_DEVICES };

// A gate while it runs.
struct rg_running_gate {
    const struct rg_gate_request *asked;
    struct rg_gate *gate;       // one case per cell that the filter selects
    int family[RG_MAX_DEVICES]; // of each course: the cells that all shards may time
    // The sides of the pairs, two by two, A first. With a baseline A has no name.
    int side_count;
    struct rg_side sides[RG_GATE_MOST_SIDES];
    struct rg_device_info infos[RG_GATE_MOST_SIDES]; // of the sides that are present
    json_t *passport;                                // of the sides that are present
    // For sides that are present and run alone.
    json_t *parts[RG_GATE_MOST_SIDES];  // of their comparison keys
    bool same_key[RG_GATE_MOST_SIDES];  // equal to the baseline's key
    bool has_fixed[RG_GATE_MOST_SIDES]; // its fixed functions are among the cases
    struct rg_truth truth;
    struct rg_launches yardsticks[RG_YARDSTICKS];
    double start_ms, end_ms;         // of the pair that runs; end 0: no limit
    double first_ms;                 // when the first pair began
    double look_ms;                  // until a pair's first look, the longest of all pairs
    bool has_looked;                 // some case reached its first look, or ended without it
    struct rg_gate_journal *journal; // NULL: no journal
};

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

#endif
