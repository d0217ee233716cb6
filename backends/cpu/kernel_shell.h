// Makes a C function of the GRID kernel that was just included: one call runs a block of items.
#include "backends/cpu/cpu.h"

#define RG_CAT_(a, b, c) rg_cpu_##a##_##b
#define RG_CAT(a, b)     RG_CAT_(a, b, )

#define RG_BIND_ARRAY(slot, name)                                                                  \
    rg.name = call->slots[slot].data;                                                              \
    rg.name##_count = call->slots[slot].count;
#define RG_BIND_IMAGE(slot, name)                                                                  \
    RG_BIND_ARRAY(slot, name)                                                                      \
    rg.name##_shape = *call->slots[slot].shape;
#define IN(slot, T, name)        RG_BIND_ARRAY(slot, name)
#define OUT(slot, T, name)       RG_BIND_ARRAY(slot, name)
#define INOUT(slot, T, name)     RG_BIND_ARRAY(slot, name)
#define ATOMIC(slot, T, name)    RG_BIND_ARRAY(slot, name)
#define IMAGE(slot, F, name)     RG_BIND_IMAGE(slot, name)
#define OUT_IMAGE(slot, F, name) RG_BIND_IMAGE(slot, name)

void RG_CAT(RG_LEVEL, RG_KERNEL_NAME)(const struct cpu_call *call);

void RG_CAT(RG_LEVEL, RG_KERNEL_NAME)(const struct cpu_call *call)
{
    rg_ctx rg;
    RG_SLOTS
    rg.fault = call->fault;
    const RG_PARAMS p = *(const RG_PARAMS *)call->params;
    // Copies, because a kernel's stores might otherwise be taken to change the call itself.
    const struct rg_extent begin = call->begin, end = call->end;
    for (int z = begin.depth; z < end.depth; z++) {
        for (int y = begin.height; y < end.height; y++) {
// Items of a run are independent (docs/dialect.md), so they may run side by side in a vector. The
// reference runs them one by one.
#if !RG_CHECKED
#pragma omp simd
#endif
            for (int x = begin.width; x < end.width; x++)
                rg_kernel(rg, p, x, y, z);
        }
    }
}
