// Passes of GRID kernels, and what DRAW passes (core/device/draw.h) have in common with them. Only
// core/device uses it: all others go through core/device/pass.h.
#ifndef RG_CORE_DEVICE_GRID_H
#define RG_CORE_DEVICE_GRID_H

#include "backends/backend.h"

// A pass of any kernel; of a DRAW program without what packs its items. NULL and one logged line on
// failure. Destroying NULL is allowed.
struct rg_pass *rg_grid_create(struct rg_device *device, const char *kernel);
void rg_grid_destroy(struct rg_pass *pass);

// Whether a run of either kind has parameters, sound items and what its slots want; else one logged
// line.
bool rg_run_check(const struct rg_pass *pass, const struct rg_run *run);
// Counts a run that was asked for (core/device/work.h).
void rg_run_count(struct rg_pass *pass, const struct rg_run *run);
// Hands the backend one run, past all checks.
bool rg_dispatch(struct rg_pass *pass, const struct rg_run *run);

// Checks and runs a GRID pass. What exceeds the device's work groups goes in several dispatches.
bool rg_grid_run(struct rg_pass *pass, const struct rg_run *run);

#endif
