// Whether a cell does the work that it is held against: only what agrees is timed.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_AGREE_H
#define RG_HARNESS_COMPARE_GATE_RUN_AGREE_H

#include "harness/compare/gate/run/cases.h"

// Runs a case's cell on its sides, which are open, and compares its picture by the tier that the
// two owe each other, its states to the bit where that is T0, and its counters and the work of a
// frame exactly. Of a baseline there is no picture, but a digest: where that is another,
// cpu:reference draws now what it should be. Fills in the agreement; where the case agrees its
// message says what is to be known of it. Pictures that differ are written into a folder, under the
// case's name (harness/compare/gate/pictures/); NULL: none are.
void rg_gate_agree(struct rg_gate_case *of, struct rg_truth *truth, const char *folder);

// Ends a case, whose side could not be launched, by the last error.
void rg_gate_agree_fails(struct rg_gate_case *of, const char *device);

// Says how long a frame takes, by what it took on a machine with another key, where the yardsticks
// took `then` and take `now` (RG_YARDSTICKS of each). It is advice, and ends nothing.
void rg_gate_advise(const struct rg_gate_row *row, const struct rg_timed_cell *timed,
                    const struct rg_launches *then, const struct rg_launches *now,
                    struct rg_agreement *agreement);

#endif
