// A baseline is made, and held against the one that is to be replaced.
#ifndef RG_HARNESS_COMPARE_GATE_BASELINE_MAKE_H
#define RG_HARNESS_COMPARE_GATE_BASELINE_MAKE_H

#include <stdio.h>

#include "harness/compare/gate/baseline/baseline.h"
#include "harness/devices/devices.h"

struct rg_baseline_request {
    const struct rg_gate_cells *cells;
    int launches; // of each device, that time each cell; 0: nothing is timed
};

// Runs all cells on all devices, which it closes, into a zeroed baseline. False, and one logged
// line, where it cannot be made, or the user interrupts. `clean` is false where a device was closed
// badly, which takes nothing from the baseline.
bool rg_baseline_make(const struct rg_baseline_request *request, struct rg_devices *devices,
                      struct rg_baseline *baseline, bool *clean);

// Prints what is another in `now` than in `then`, a line a cell. Returns how many lines that were.
// Times are another where a gate of the same cells would find it.
int rg_baseline_print_changes(const struct rg_baseline *then, const struct rg_baseline *now,
                              FILE *out);

#endif
