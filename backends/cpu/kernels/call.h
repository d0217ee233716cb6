// The arguments and results of a compiled kernel. Kernels include nothing else of the backend, so
// that changes elsewhere do not recompile them.
#ifndef RG_BACKENDS_CPU_KERNELS_CALL_H
#define RG_BACKENDS_CPU_KERNELS_CALL_H

#include "backends/cpu/kernels/notes.h"
#include "kernels/dialect/image/memory.h"

struct cpu_slot {
    void *data;
    int count;                   // elements, or an image's words
    const rg_image_shape *shape; // of an image
};

// The target of a DRAW program: the texels of one layer of one level.
struct cpu_target {
    uint *colour, *depth; // NULL: none
    uint *samples;        // by item; NULL: not counted
};

struct cpu_xyz {
    int x, y, z;
};

// A block of items begin <= (x, y, z) < end, for one thread.
struct cpu_call {
    const void *params;
    struct cpu_slot slots[RG_MAX_SLOTS];
    struct cpu_xyz begin, end;
    struct rg_notes *notes;   // for the reference level only
    struct cpu_target target; // for DRAW programs
};

// A kernel of one instruction set.
struct cpu_kernel {
    void (*run)(
        const struct cpu_call *call);  // NULL: a DRAW program, run by its stages (draw/program.h)
    const struct cpu_program *program; // those stages; else NULL
};

#endif
