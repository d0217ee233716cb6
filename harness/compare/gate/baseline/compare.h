// A cell as it is now, against what a baseline has of it.
#ifndef RG_HARNESS_COMPARE_GATE_BASELINE_COMPARE_H
#define RG_HARNESS_COMPARE_GATE_BASELINE_COMPARE_H

#include "harness/compare/gate/baseline/take.h"

// Makes of what is unsupported now, a device that is not there or a cell that it cannot run, a
// difference, where it ran when the baseline was made.
void rg_against_end(const struct rg_baseline_row *before, struct rg_agreement *agreement);

// Runs a cell, and ends the agreement where it is not what it was: states, counters and the work of
// a frame exactly; a picture of another digest must be that of cpu:reference, drawn now, by the
// tier that the device owes. Where it agrees the message says what is to be known of it.
void rg_against_compare(const struct rg_gate_cell *cell, struct rg_device *device,
                        const struct rg_baseline_row *before, struct rg_truth *truth,
                        struct rg_agreement *agreement);

// Says how long a frame takes, by what it took on a machine with another key, where the yardsticks
// took `then` and take `now` (RG_YARDSTICKS of each). It is advice, and ends nothing.
void rg_against_advise(const struct rg_gate_row *row, const struct rg_timed_cell *timed,
                       const struct rg_launches *then, const struct rg_launches *now,
                       struct rg_agreement *agreement);

#endif
