// The cells of a group of tests.
#ifndef RG_TESTS_HARNESS_GATE_CELLS_READ_H
#define RG_TESTS_HARNESS_GATE_CELLS_READ_H

#include <string.h>

#include "harness/compare/gate/cells/cells.h"

static struct rg_gate_cells cells;

// Of a text; returns what a setup does.
static inline int read_cells(const char *text)
{
    return !rg_gate_cells_of("cells", text, strlen(text), &cells);
}

static inline int free_cells(void **state)
{
    (void)state;
    rg_gate_cells_free(&cells);
    return 0;
}

#endif
