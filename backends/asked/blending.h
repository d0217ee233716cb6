// Decides whether the driver blends or the programs themselves do (kernels/dialect/draw/blend.h).
#ifndef RG_BACKENDS_ASKED_BLENDING_H
#define RG_BACKENDS_ASKED_BLENDING_H

#include <stdbool.h>

struct rg_device;

// Sets `blends` of a newly created device, and notes it in its API's name. RG_BLENDING, if set,
// decides. Otherwise a device whose tier does not promise cpu:reference's drawing is tested: layers
// of panes in each format, over and added, are compared with a loop in C. If a bit differs,
// programs blend if the driver lets them. False, and one logged line, if that variable is invalid
// or asks for something that the driver lacks, or if the device failed.
bool rg_blending_settle(struct rg_device *device);

#endif
