// A gate compares its cells with another side or with a baseline, then times those that agree, and
// reports what is worse.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_GATE_H
#define RG_HARNESS_COMPARE_GATE_RUN_GATE_H

#include "harness/compare/gate/run/cases.h"

// The results of a gate; they point into the request. Zeroed before; the owner calls rg_gate_free.
struct rg_gate {
    int chosen;    // cases that the filter selects, of which the shard has some
    json_t *names; // of all of them; owned
    struct rg_report report;
    bool is_told;   // the report is complete
    int told_count; // the first so many cases of the report are those of cells, in their order
    int beyond;     // an enum rg_exit of what the report does not tell
    int case_count;
    struct rg_gate_case *cases;
    int64_t result_count;
    struct rg_known_result *results;   // for rg_known_mend: cases, and cells that were left out
    char *note;                        // text for people above the report; owned
    char drivers[RG_MAX_DEVICES][160]; // of results of fixed functions
};
void rg_gate_free(struct rg_gate *gate);

// Runs the gate: compares first, then times. A baseline's times are compared if the device's
// comparison key is the same; otherwise they are reported together with the yardsticks, and fail
// nothing. Returns an enum rg_exit: fail if something is worse or broken, inconclusive if the times
// do not decide, nothing measured if nothing was compared, unsupported if a side is.
int rg_gate_run(const struct rg_gate_request *request, struct rg_gate *gate);

// Only fills in the names of the cases that the filter selects, and runs nothing. False, and one
// logged line, without memory.
bool rg_gate_list(const struct rg_gate_request *request, struct rg_gate *gate);

// Whether a pair has a case of its fixed functions (run/fixed.c): the baseline has digests of B's,
// or, with none, A and B are two drivers of an API that draws them.
bool rg_gate_has_fixed(const struct rg_baseline *baseline, const struct rg_gate_pair *pair);

// --- the results of its cases ---

// Makes the report of all cases, and their results. False, and one logged line, without memory.
bool rg_gate_report(const struct rg_gate_request *request, struct rg_gate *gate);
// Adds a failing case for each device that `require` names (NULL: none) which has cases in the
// report and none that was compared. False, and one logged line, if a name is malformed.
bool rg_gate_hold_required(const char *require, struct rg_report *report);
// The exit status of a gate whose report is complete, without `beyond`; if nothing was compared,
// logs one line.
int rg_gate_exit(const struct rg_gate_request *request, const struct rg_gate *gate);

#endif
