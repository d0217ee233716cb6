// Makes the context of the kernel that was just included from a call's bindings.
#include "backends/cpu/kernels/call.h"

#define RG_CAT_(a, b) rg_cpu_##a##_##b
#define RG_CAT(a, b)  RG_CAT_(a, b)

// Begins the definition of the object that the kernel's file exports.
#define RG_EXPORT_KERNEL                                                                           \
    extern const struct cpu_kernel RG_CAT(RG_LEVEL, RG_KERNEL_NAME);                               \
    const struct cpu_kernel RG_CAT(RG_LEVEL, RG_KERNEL_NAME)

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

static inline __attribute__((always_inline)) rg_ctx bind_context(const struct cpu_call *call)
{
    rg_ctx rg;
    RG_ALL_SLOTS
    rg.notes = call->notes;
    rg.plain = 0;
    return rg;
}
