// The state of a draw, for the stages of its DRAW pass: core/device/draw.c makes it, and the shells
// read it.
#ifndef RG_KERNELS_DIALECT_DRAW_STATE_H
#define RG_KERNELS_DIALECT_DRAW_STATE_H

#include "kernels/dialect/lang.h"

// The items that one work item of the packing stages handles, in order; each has a bit of a word.
#define RG_DRAW_CHUNK 32

// enum rg_format of backends/formats.h.
#define RG_RGBA8_FORMAT   1
#define RG_RGBA16F_FORMAT 2
#define RG_RGBA32F_FORMAT 3

// enum rg_depth_mode of backends/backend.h.
#define RG_DEPTH_IS_OFF   0
#define RG_DEPTH_IS_TEST  1
#define RG_DEPTH_IS_WRITE 2

RG_STRUCT(rg_draw_state)
{
    int item_begin, item_end; // items of this batch
    int capacity;             // of the buffer of primitives
    int width, height;        // of the target, in pixels
    int x0, y0, x1, y1;       // the scissor: pixels x0 <= x < x1, y0 <= y < y1
    float half_width;         // of the target, in pixels
    float half_height;
    int cull;          // enum rg_cull of backends/backend.h
    int blend;         // enum rg_blend
    int depth_mode;    // enum rg_depth_mode
    int colour_format; // enum rg_format; 0: none
    int counted;       // 1: visible samples are counted, item by item
};
RG_STRUCT_SIZE(rg_draw_state, 16)

#endif
