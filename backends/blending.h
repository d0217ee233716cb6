// Decides whether the driver blends or the programs themselves do (kernels/dialect/draw/blend.h).
#ifndef RG_BACKENDS_BLENDING_H
#define RG_BACKENDS_BLENDING_H

#include <stdbool.h>

struct rg_device;

// Sets `blends` of a newly created device, and notes it in its API's name. A device whose tier does
// not say that it draws as cpu:reference does is tested with layers of panes in each format, over
// and added, against a loop in C; where a bit differs, programs blend if the driver lets them.
// RG_BLENDING, if set, decides instead. False, and one logged line, where that variable is invalid
// or asks for what the driver lacks, or the device failed.
bool rg_blending_settle(struct rg_device *device);

#endif
