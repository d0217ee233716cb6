// The command that compares a cell's pictures again.
#ifndef RG_HARNESS_COMPARE_GATE_CELLS_AGAIN_H
#define RG_HARNESS_COMPARE_GATE_CELLS_AGAIN_H

#include <stdio.h>

#include "harness/compare/gate/cells/cells.h"

// Writes `raingauge diff` of a cell on two devices, with its mutants, as a shell takes it.
void rg_gate_cell_again(FILE *out, const struct rg_gate_cell *cell, const char *a, const char *b);

#endif
