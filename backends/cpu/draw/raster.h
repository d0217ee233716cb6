// Vectorised parts of drawing that programs share, compiled for each level.
#ifndef RG_BACKENDS_CPU_DRAW_RASTER_H
#define RG_BACKENDS_CPU_DRAW_RASTER_H

#include "backends/cpu/draw/bins.h"

struct cpu_raster {
    // Finds the coverage of each shape. Shapes of three corners repeat the last one.
    void (*cover)(const rg_draw_state *draw, const struct cpu_items *items,
                  struct cpu_shapes *shapes);
    // Draws a tile.
    void (*shade)(const struct cpu_program *program, const struct cpu_call *call,
                  const struct cpu_bins *bins, int tile);
};

#endif
