// What drawing shares among programs and is worth vectors: which pixels shapes cover, and how tiles
// are shaded.
#ifndef RG_BACKENDS_CPU_DRAW_RASTER_H
#define RG_BACKENDS_CPU_DRAW_RASTER_H

#include "backends/cpu/draw/program.h"

struct cpu_bins;

enum { CPU_MASKS = 4 }; // of a shape

// What covers pixels, perhaps: where its corners are, and which pixels it covers.
enum cpu_cover { CPU_COVERS_NONE, CPU_COVERS_MASK, CPU_COVERS_MORE };
struct cpu_shapes {
    int count;
    int place[CPU_PLACES]; // in cpu_items
    int item[CPU_PLACES];
    int cover[CPU_PLACES]; // enum cpu_cover
    // Where the pixels begin, and masks of eight by eight from there on, one below the other.
    // Bit 8 y + x.
    int x[CPU_PLACES], y[CPU_PLACES];
    int masks[CPU_PLACES];
    uint64_t mask[CPU_MASKS][CPU_PLACES];
};

// What drawing shares among programs, of one level.
struct cpu_raster {
    // Says of each shape what it covers. Shapes of three corners have their last one twice.
    void (*cover)(const rg_draw_state *draw, const struct cpu_items *items,
                  struct cpu_shapes *shapes);
    // Draws a tile.
    void (*shade)(const struct cpu_program *program, const struct cpu_call *call,
                  const struct cpu_bins *bins, int tile);
};

#endif
