// Warnings about expectations that match no cell, device or driver, or whose days are far away.
#ifndef RG_HARNESS_COMPARE_GATE_CELLS_UNUSED_H
#define RG_HARNESS_COMPARE_GATE_CELLS_UNUSED_H

#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/expected/expected.h"

// Logs a warning "FILE:LINE: ..." for the first expectation of each file whose pattern matches no
// cell. Its name may be mistyped, or the cell is gone; without a warning it would stay unused for
// ever. Mesa's files are left out, because they are of other suites too. Returns the number of such
// expectations.
int64_t rg_gate_warn_of_unused(const struct rg_known *known, const struct rg_gate_cells *cells);

// A device whose cells are compared with expectations.
struct rg_gate_target {
    const char *device, *driver; // NULL driver: the device is absent
};
// The same for expectations that match a cell but no device of these, or no driver of the matching
// devices that are present.
int64_t rg_gate_warn_of_unused_on(const struct rg_known *known, const struct rg_gate_cells *cells,
                                  const struct rg_gate_target *targets, int count);

// The same for expectations that begin after this day, and for those that last more than a year
// from it: one line for each kind and file.
int64_t rg_gate_warn_of_days(const struct rg_known *known, int today);

#endif
