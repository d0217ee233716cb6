// Makes a C function of the GRID kernel that was just included: one call runs a block of items.
#include "backends/cpu/kernels/bind_tmpl.h"

// Items of a run are independent (docs/dialect.md), so they may be vectorised. The reference runs
// them one by one.
static inline __attribute__((always_inline)) void run_items(rg_ctx rg, RG_RUN_PARAMS p, int begin,
                                                            int end, int y, int z)
{
#if !RG_CHECKED
#pragma omp simd
#endif
    for (int x = begin; x < end; x++)
        rg_kernel(rg, p, x, y, z);
}

// The reference also runs items that claim to have nothing to do, which tests the claim.
#if defined(RG_IDLE_ITEMS) && !RG_CHECKED
static inline __attribute__((always_inline)) void run_row(rg_ctx rg, RG_RUN_PARAMS p, int begin,
                                                          int end, int y, int z)
{
    for (int from = begin, x; from < end; from = x + RG_IDLE_ITEMS) {
        for (x = from; x < end; x += RG_IDLE_ITEMS)
            if (x + RG_IDLE_ITEMS <= end && rg_is_idle(rg, p, x, y, z, RG_IDLE_ITEMS))
                break;
        run_items(rg, p, from, x < end ? x : end, y, z);
    }
}
#else
#define run_row run_items
#endif

static void run_block(const struct cpu_call *call)
{
    const rg_ctx rg = bind_context(call);
    const RG_RUN_PARAMS p = *(const RG_RUN_PARAMS *)call->params;
    // Copies, because a kernel's stores might otherwise be assumed to change the call itself.
    const struct cpu_xyz begin = call->begin, end = call->end;
    for (int z = begin.z; z < end.z; z++)
        for (int y = begin.y; y < end.y; y++)
            run_row(rg, p, begin.x, end.x, y, z);
}

RG_EXPORT_KERNEL = {.run = run_block};
