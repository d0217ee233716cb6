// Passes of GRID kernels, and functions that DRAW passes (core/device/draw.h) share with them. Only
// core/device includes it; others use core/device/pass.h.
#ifndef RG_CORE_DEVICE_GRID_H
#define RG_CORE_DEVICE_GRID_H

#include "backends/backend.h"

// Creates a pass of any kernel, without the packing passes of a DRAW program. NULL and one logged
// line on failure. Destroying NULL is allowed.
struct rg_pass *rg_grid_create(struct rg_device *device, const char *kernel);
void rg_grid_destroy(struct rg_pass *pass);

// Whether a run of either kind has parameters, valid items and the right object in each slot; else
// one logged line.
bool rg_run_check(const struct rg_pass *pass, const struct rg_run *run);
// Counts a run that was asked for (core/device/work.h).
void rg_run_count(struct rg_pass *pass, const struct rg_run *run);
// Hands the backend one run without checking it.
bool rg_dispatch(struct rg_pass *pass, const struct rg_run *run);

// Checks and runs a GRID pass, in several dispatches where it exceeds the device's work groups.
bool rg_grid_run(struct rg_pass *pass, const struct rg_run *run);

#endif
