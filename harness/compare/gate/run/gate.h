// A gate: its cells held against another side, or against a baseline; compared first and timed
// where they agree, and what of that is worse than it was.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_GATE_H
#define RG_HARNESS_COMPARE_GATE_RUN_GATE_H

#include "harness/compare/gate/run/cases.h"

// What a gate leaves behind; it points into the request. Zeroed before; the owner calls
// rg_gate_free.
struct rg_gate {
    int chosen; // cases that the filter lets through, of which the shard has some
    struct rg_report report;
    bool is_told; // the report is whole
    int case_count;
    struct rg_gate_case *cases;
    int64_t result_count;
    struct rg_known_result *results; // for rg_known_mend: one a case, and a cell of what was left
    char *note;                      // what is printed for people above the report; owned
};
void rg_gate_free(struct rg_gate *gate);

// The name of a cell's case on B: "streaks/rain.vulkan@VK_DRIVER_FILES=new.json", with characters
// that a report cannot hold replaced, so that filters know it as lists have it; the caller frees
// it. NULL, and one logged line, without memory.
char *rg_gate_case_name(const struct rg_gate_cell *cell, const char *device);

// Runs it. What is the same every time is compared first. Times of a baseline are held against
// those now where the device's comparison key is the same, and are else told beside the yardsticks,
// which fails nothing. Returns an enum rg_exit: fail where something is worse or broken,
// inconclusive where times leave it open, nothing measured where nothing was compared, unsupported
// where a side is.
int rg_gate_run(const struct rg_gate_request *request, struct rg_gate *gate);

// --- what came of its cases ---

// Makes the report of all cases, and the results. False, and one logged line, without memory.
bool rg_gate_report(const struct rg_gate_request *request, struct rg_gate *gate);
// The exit status of one whose report is whole; where nothing was compared, one line is logged.
int rg_gate_exit(const struct rg_gate_request *request, const struct rg_gate *gate);

#endif
