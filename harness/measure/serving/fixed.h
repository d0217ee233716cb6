// A draw of a fixed function and its neighbour, on the device of a worker.
#ifndef RG_HARNESS_MEASURE_SERVING_FIXED_H
#define RG_HARNESS_MEASURE_SERVING_FIXED_H

#include "core/device/device.h"
#include "harness/devices/workers/fields.h"

struct rg_fixed_told {
    char lacks[80];             // what the device lacks for either; "": nothing
    uint64_t digest, neighbour; // XXH3 of all that each left
    bool is_constant;           // a part of the draw is the same everywhere
};

extern const struct rg_field rg_fixed_fields[];

// Draws a row of rg_fixed_draws. False, and one logged line, on failure.
bool rg_fixed_take(struct rg_device *device, int row, struct rg_fixed_told *told);

// The same in the device's worker, or here if it has none.
bool rg_fixed_ask(struct rg_device *device, int row, struct rg_fixed_told *told);

#endif
