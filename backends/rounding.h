// Decides whether the driver or the programs themselves round quotients and roots
// (kernels/dialect/rounding.h).
#ifndef RG_BACKENDS_ROUNDING_H
#define RG_BACKENDS_ROUNDING_H

#include <stdbool.h>

struct rg_device;

// Sets `rounds` of a newly created device, and notes it in its API's name. A device of a `rough`
// backend is tested with 65,536 quotients and as many roots, unless its tier says that it computes
// as C does; RG_ROUNDING, if set, decides instead. False, and one logged line, where that variable
// is invalid, or the device failed.
bool rg_rounding_settle(struct rg_device *device);

#endif
