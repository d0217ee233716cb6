// Makes a C function of the GRID kernel that was just included: one call runs a block of items.
#include "backends/cpu/kernels/bind_tmpl.h"

static void run_block(const struct cpu_call *call)
{
    const rg_ctx rg = bind_context(call);
    const RG_RUN_PARAMS p = *(const RG_RUN_PARAMS *)call->params;
    // Copies, because a kernel's stores might otherwise be taken to change the call itself.
    const struct cpu_xyz begin = call->begin, end = call->end;
    for (int z = begin.z; z < end.z; z++) {
        for (int y = begin.y; y < end.y; y++) {
// Items of a run are independent (docs/dialect.md), so they may run side by side in a vector. The
// reference runs them one by one.
#if !RG_CHECKED
#pragma omp simd
#endif
            for (int x = begin.x; x < end.x; x++)
                rg_kernel(rg, p, x, y, z);
        }
    }
}

RG_EXPORT_KERNEL = {.run = run_block};
