// A gate that holds devices against a baseline, where the other one has two sides that run now.
#ifndef RG_HARNESS_COMPARE_GATE_BASELINE_AGAINST_H
#define RG_HARNESS_COMPARE_GATE_BASELINE_AGAINST_H

#include "harness/compare/gate/baseline/baseline.h"
#include "harness/compare/gate/run/gate.h"

struct rg_against {
    // Its pairs say nothing; its margin is that of times that were taken apart.
    const struct rg_gate_request *request;
    const struct rg_baseline *baseline; // whose cells are the request's (rg_baseline_fits)
    const char *devices;                // names with commas; NULL: all of the baseline's
};

// The name of a row's case, as rg_gate_case_name makes it, is "raster/torus.cpu".
//
// Runs each cell that the baseline has of the devices, and holds it against that: what is the same
// every time first. Times are held against each other where the device's comparison key is the
// same, and are else told beside the yardsticks, which fails nothing. Returns an enum rg_exit as
// rg_gate_run does.
int rg_against_run(const struct rg_against *against, struct rg_gate *gate);

#endif
