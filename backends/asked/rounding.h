// Decides whether the driver or the programs themselves round quotients and roots
// (kernels/dialect/rounding.h).
#ifndef RG_BACKENDS_ASKED_ROUNDING_H
#define RG_BACKENDS_ASKED_ROUNDING_H

#include <stdbool.h>

struct rg_device;

// Sets `rounds` of a newly created device, and notes it in its API's name. RG_ROUNDING, if set,
// decides. Otherwise a device of a `rough` backend is tested with 65,536 quotients and as many
// roots, unless its tier promises C's arithmetic. False, and one logged line, if that variable is
// invalid, or if the device failed.
bool rg_rounding_settle(struct rg_device *device);

#endif
