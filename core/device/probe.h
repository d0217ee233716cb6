// The floating-point probe: does a device compute what the dialect promises, to the last bit?
#ifndef RG_CORE_DEVICE_PROBE_H
#define RG_CORE_DEVICE_PROBE_H

#include <stdbool.h>
#include <stdint.h>

#include "kernels/probe/list.h"

struct rg_device;

#define RG_PROBE_COUNT_ROW(number, name, inputs, result, expression) +1
enum {
    RG_PROBE_OP_COUNT = 0 RG_PROBE_OPS(RG_PROBE_COUNT_ROW),
    RG_PROBE_BUILTIN_COUNT = 0 RG_PROBE_BUILTINS(RG_PROBE_COUNT_ROW),
    RG_PROBE_COUNT = RG_PROBE_OP_COUNT + RG_PROBE_BUILTIN_COUNT,
    RG_PROBE_INPUTS = 65536, // for each operation
};

struct rg_probe_result {
    const char *name;
    bool builtin;          // the driver's own function, which may differ because no kernel uses it
    int compared;          // inputs
    int different;         // results whose bits differ
    uint32_t largest_ulps; // distance in neighbouring floats, or of integers
};

// Gives results their names and kinds, and zeros.
void rg_probe_name(struct rg_probe_result results[RG_PROBE_COUNT]);

// Runs every operation of kernels/probe/list.h on seeded inputs and compares the bits. Plain
// operations are compared with C on the host; builtins, and operations that the dialect composes,
// with cpu:reference. False, and one logged line, when a device failed.
bool rg_probe_run(struct rg_device *device, struct rg_probe_result results[RG_PROBE_COUNT]);

#endif
