// Does a device draw what cpu:reference draws? What probes its arithmetic makes no pipeline.
#ifndef RG_HARNESS_MEASURE_DRAWING_H
#define RG_HARNESS_MEASURE_DRAWING_H

#include "backends/backend.h"

// 3 formats can be drawn to.
enum { RG_DRAWING_FORMATS = 3, RG_DRAWING_PIXELS = 128 * 96 };

struct rg_drawing {
    int count; // of formats that the device says it can draw to; 0: its limits say why
    struct rg_drawn {
        enum rg_format format;
        int differing; // of RG_DRAWING_PIXELS: another depth, or a colour that its tier forbids
    } formats[RG_DRAWING_FORMATS];
    double ms; // that all draws took, once the driver had compiled what they take
};

// Draws panes that hide and show through each other, with depth and blending, into each format, and
// compares colour and depth. False, and one logged line, where the device failed.
bool rg_drawing_check(struct rg_device *device, struct rg_drawing *drawing);

// Whether so many pixels may differ: none of a device of T0, and one of 1,000 of others, of which a
// pixel differs where a colour is off by more than two codes.
bool rg_drawn_is_well(const struct rg_drawn *drawn, enum rg_tier tier);

#endif
