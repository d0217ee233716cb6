// DRAW passes behind core/device/device.c: their checks, and the packing of items for the backends
// that ask for it. Items are counted, chunk by chunk; a scan gives each chunk its place; then the
// primitives of the items that are seen are written there, in order (kernels/dialect/draw/count.h,
// kernels/dialect/draw/emit.h). Long ranges go in batches, so that the packed primitives stay below
// what a device allows a buffer.
#ifndef RG_CORE_DEVICE_DRAW_H
#define RG_CORE_DEVICE_DRAW_H

#include "backends/backend.h"

// The two packing passes of a DRAW pass; what they write is shared by all passes of a device.
struct rg_packer {
    struct rg_pass *count, *emit;
};

bool rg_packer_create(struct rg_pass *pass);
void rg_packer_destroy(struct rg_pass *pass);

// Frees what packing holds of a device, before it closes.
void rg_packing_destroy(struct rg_device *device);

// Whether a run of a DRAW pass names sound targets; else one logged line.
bool rg_draw_check(const struct rg_pass *pass, const struct rg_run *run);
// Runs it, checked.
bool rg_draw_run(struct rg_pass *pass, const struct rg_run *run);

#endif
