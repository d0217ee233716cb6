// Shapes: corners of a batch that may cover pixels, and masks of the covered pixels.
#ifndef RG_BACKENDS_CPU_DRAW_SHAPES_H
#define RG_BACKENDS_CPU_DRAW_SHAPES_H

#include "backends/cpu/draw/program.h"

enum { CPU_MASKS = 4 }; // of one shape

// The corners' places in cpu_items, and the pixels that they cover.
enum cpu_cover { CPU_COVERS_NONE, CPU_COVERS_MASK, CPU_COVERS_MORE };
struct cpu_shapes {
    int count;
    int place[CPU_PLACES]; // in cpu_items
    int item[CPU_PLACES];
    int cover[CPU_PLACES]; // enum cpu_cover
    // The first pixel, and masks of eight by eight from there on, one below the other. A pixel's
    // bit is 8 y + x.
    int x[CPU_PLACES], y[CPU_PLACES];
    int masks[CPU_PLACES];
    uint64_t mask[CPU_MASKS][CPU_PLACES];
};

#endif
