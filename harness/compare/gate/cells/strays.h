// Expectations of cells, devices and drivers that there are none of, and of days far away.
#ifndef RG_HARNESS_COMPARE_GATE_CELLS_STRAYS_H
#define RG_HARNESS_COMPARE_GATE_CELLS_STRAYS_H

#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/expected/expected.h"

// Logs a warning "FILE:LINE: ..." for the first expectation of each file whose pattern is of no
// cell: its name is mistyped, or what it was of is gone, and it would be silent about that for
// ever. Mesa's files are not looked at, for they are of other suites as well. Returns how many
// expectations there are of that kind.
int64_t rg_gate_warn_of_strays(const struct rg_known *known, const struct rg_gate_cells *cells);

// A device that cells are held to what is expected of.
struct rg_gate_target {
    const char *device, *driver; // driver NULL: it is not there, and has none
};
// The same of the expectations whose cell is here, and whose device none of these is, or whose
// driver none of those has that are such a device and are there.
int64_t rg_gate_warn_of_strange(const struct rg_known *known, const struct rg_gate_cells *cells,
                                const struct rg_gate_target *targets, int count);

// The same of the expectations that begin behind this day, and of those that hold for more than a
// year from it: a line each a file.
int64_t rg_gate_warn_of_days(const struct rg_known *known, int today);

#endif
