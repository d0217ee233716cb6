// Who rounds a device's quotients and roots: its driver, or programs themselves
// (kernels/dialect/rounding.h).
#ifndef RG_BACKENDS_ROUNDING_H
#define RG_BACKENDS_ROUNDING_H

#include <stdbool.h>

struct rg_device;

// Sets `rounds` of a device that has just been created, and its API's name says so. A device of a
// `rough` backend is asked for 65,536 quotients and as many roots unless its tier says that it
// computes as C does; RG_ROUNDING decides instead where it is set. False, and one logged line,
// where that variable is no choice, or the device failed.
bool rg_rounding_settle(struct rg_device *device);

#endif
