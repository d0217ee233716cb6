// Makes an OpenCL kernel of a GRID kernel. Arguments: origin and end of the run, the parameters, then
// for each slot in ascending order a buffer and its element count, and an image's shape.
#include RG_KERNEL_HEADER

#define RG_ARRAY_ARG(T, name)    , __global T *name, int name##_count
#define IN(slot, T, name)        RG_ARRAY_ARG(const T, name)
#define OUT(slot, T, name)       RG_ARRAY_ARG(T, name)
#define INOUT(slot, T, name)     RG_ARRAY_ARG(T, name)
#define ATOMIC(slot, T, name)    RG_ARRAY_ARG(T, name)
#define IMAGE(slot, F, name)     RG_ARRAY_ARG(const uint, name), rg_image_shape name##_shape
#define OUT_IMAGE(slot, F, name) RG_ARRAY_ARG(uint, name), rg_image_shape name##_shape

__attribute__((reqd_work_group_size(64, 1, 1)))
__kernel void rg_grid(int4 origin, int4 end, RG_RUN_PARAMS params RG_ALL_SLOTS)
{
#undef IN
#undef OUT
#undef INOUT
#undef ATOMIC
#undef IMAGE
#undef OUT_IMAGE
#define RG_ARRAY_BIND(name)      rg.name = name; rg.name##_count = name##_count;
#define IN(slot, T, name)        RG_ARRAY_BIND(name)
#define OUT(slot, T, name)       RG_ARRAY_BIND(name)
#define INOUT(slot, T, name)     RG_ARRAY_BIND(name)
#define ATOMIC(slot, T, name)    RG_ARRAY_BIND(name)
#define IMAGE(slot, F, name)     RG_ARRAY_BIND(name) rg.name##_shape = name##_shape;
#define OUT_IMAGE(slot, F, name) RG_ARRAY_BIND(name) rg.name##_shape = name##_shape;
    rg_ctx rg;
    RG_ALL_SLOTS
    int x = origin.x + (int)get_global_id(0);
    int y = origin.y + (int)get_global_id(1);
    int z = origin.z + (int)get_global_id(2);
    if (x < end.x && y < end.y && z < end.z)
        rg_kernel(rg, params, x, y, z);
}
