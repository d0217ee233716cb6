// A unit normal in one word: three components of 10 bits each.
#ifndef RG_KERNELS_DIALECT_MESH_NORMAL_H
#define RG_KERNELS_DIALECT_MESH_NORMAL_H

#include "kernels/dialect/vec.h"

RG_FN uint mesh_snorm10(float v)
{
    return rg_to_uint(rg_to_int(rg_floor(rg_clamp(v, -1.0f, 1.0f) * 511.0f + 512.5f)));
}

RG_FN uint mesh_normal_pack(v3 n)
{
    return mesh_snorm10(n.x) | (mesh_snorm10(n.y) << 10) | (mesh_snorm10(n.z) << 20);
}

RG_FN float mesh_normal_component(uint bits)
{
    return rg_to_float(rg_to_int(bits & 0x3ffu) - 512) * (1.0f / 511.0f);
}

RG_FN v3 mesh_normal_unpack(uint bits)
{
    return v3_make(mesh_normal_component(bits), mesh_normal_component(bits >> 10),
                   mesh_normal_component(bits >> 20));
}

#endif
