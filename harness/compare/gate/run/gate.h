// A gate: its cells on two sides, compared first and timed where they agree, and what of that is
// worse than it was.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_GATE_H
#define RG_HARNESS_COMPARE_GATE_RUN_GATE_H

#include "harness/compare/gate/run/request.h"

// What a gate leaves behind; it points into the request. Zeroed before; the owner calls
// rg_gate_free.
struct rg_gate {
    struct rg_report report;
    int case_count;
    struct rg_gate_case *cases; // harness/compare/gate/run/cases.h
    int64_t result_count;
    struct rg_known_result *results; // one a case that ran, for rg_known_patch
};

// The name of a cell's case on B: "streaks/rain.vulkan@VK_DRIVER_FILES=new.json"; the caller frees
// it. NULL, and one logged line, without memory.
char *rg_gate_case_name(const struct rg_gate_cell *cell, const char *device);

// Runs it. Returns an enum rg_exit: fail where something is worse or broken, inconclusive where
// times leave it open, nothing measured where nothing was compared, unsupported where a side is.
int rg_gate_run(const struct rg_gate_request *request, struct rg_gate *gate);
// The exit status of a report that is whole.
int rg_gate_exit(const struct rg_report *report);
void rg_gate_free(struct rg_gate *gate);

#endif
