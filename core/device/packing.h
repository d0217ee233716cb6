// Packs items into primitives for the backends that ask for it. Items are counted, chunk by chunk;
// a scan gives each chunk its place; then the primitives of the items that are seen are written
// there, in order (kernels/dialect/draw/count.h, kernels/dialect/draw/emit.h).
#ifndef RG_CORE_DEVICE_PACKING_H
#define RG_CORE_DEVICE_PACKING_H

#include "backends/backend.h"
#include "kernels/dialect/draw/state.h"

// The two packing passes of a DRAW pass; all passes of a device share their output buffers.
struct rg_packer {
    struct rg_pass *count, *emit;
};

// Makes pass->packer; false and one logged line on failure. A pass without one may be destroyed.
bool rg_packer_create(struct rg_pass *pass);
void rg_packer_destroy(struct rg_pass *pass);

// Makes room for the primitives of a batch of up to `items` items, as many as the device's buffer
// size allows. If these are fewer than `items`, they are rounded down to a multiple of `whole` (0:
// any number). Returns the number of items; 0, and one logged line, when memory runs out.
// `capacity` gets the number of primitives that fit.
int rg_packing_prepare(struct rg_pass *pass, int items, int whole, int *capacity);
// Packs the batch of items that `state` names, and draws it. False, and one logged line, on
// failure.
bool rg_packing_run(struct rg_pass *pass, const struct rg_run *run, const rg_draw_state *state);
// Frees a device's packing buffers, before it closes.
void rg_packing_destroy(struct rg_device *device);

#endif
