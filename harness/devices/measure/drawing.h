// Checks that a device draws what cpu:reference draws, since the probe of arithmetic uses no
// graphics pipeline.
#ifndef RG_HARNESS_DEVICES_MEASURE_DRAWING_H
#define RG_HARNESS_DEVICES_MEASURE_DRAWING_H

#include "backends/backend.h"

// The number of formats that can be drawn to, and the pixels of a test image.
enum { RG_DRAWING_FORMATS = 3, RG_DRAWING_PIXELS = 128 * 96 };

struct rg_drawing {
    int count; // of formats that the device says it can draw to; 0: its limits say why
    struct rg_drawn {
        enum rg_format format;
        int differing; // of RG_DRAWING_PIXELS: beyond the tier in colour, or in depth at all
    } formats[RG_DRAWING_FORMATS];
    double ms; // of all draws, without compiling
};

// Draws panes that hide and show through each other, with depth and blending, to each format, and
// compares colour and depth. False, and one logged line, if the device failed.
bool rg_drawing_check(struct rg_device *device, struct rg_drawing *drawing);

// Whether the number of differing pixels is acceptable: 0 on devices of T0, one in 1,000 on others.
// A pixel counts if a colour is off by more than two codes.
bool rg_drawn_is_well(const struct rg_drawn *drawn, enum rg_tier tier);

#endif
