// The first step of a round: turns items into primitives and references to them.
#ifndef RG_BACKENDS_CPU_DRAW_EMIT_H
#define RG_BACKENDS_CPU_DRAW_EMIT_H

#include "backends/cpu/draw/raster.h"

// The first step's state of one thread and chunk.
struct cpu_emitter {
    const struct cpu_program *program;
    const struct cpu_raster *raster;
    const struct cpu_call *call;
    const rg_draw_state *draw;
    struct cpu_bins *bins;
    struct cpu_sorter *sorter;
};
void cpu_emit(const struct cpu_emitter *emitter, int chunk, int end);

#endif
