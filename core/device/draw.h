// Runs of DRAW passes. Long ranges of items go in batches, each packed first where the backend asks
// for it (core/device/packing.h).
#ifndef RG_CORE_DEVICE_DRAW_H
#define RG_CORE_DEVICE_DRAW_H

#include "backends/backend.h"

// Checks and runs a DRAW pass. False, and one logged line, where a check or the driver refuses it.
bool rg_draw_run(struct rg_pass *pass, const struct rg_run *run);

#endif
