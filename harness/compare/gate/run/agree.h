// Whether both sides of a gate do the same work: only what agrees is timed.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_AGREE_H
#define RG_HARNESS_COMPARE_GATE_RUN_AGREE_H

#include "harness/compare/gate/run/alike.h"
#include "harness/compare/gate/run/sides.h"

// Runs a cell on both sides, which are open, and compares its picture, by the tier that the two owe
// each other, its states to the bit where that is T0, and its counters and the work of a frame
// exactly. Pictures that differ are written into a folder, under the case's name
// (harness/compare/gate/pictures/); NULL: none are.
void rg_gate_agree(const struct rg_gate_cell *cell, struct rg_side sides[RG_SIDES],
                   const char *folder, const char *name, struct rg_agreement *agreement);

#endif
