// A texel of a normal map in one word: the normal's x and y in 12 bits each, wetness in 8.
#ifndef RG_KERNELS_FLOW_PANES_NORMAL_MAP_H
#define RG_KERNELS_FLOW_PANES_NORMAL_MAP_H

#include "kernels/dialect/lang.h"

// The stored integers, as floats; wet_normal_component and wet_normal_wetness scale them.
RG_STRUCT(wet_normal)
{
    float x;
    float y;
    float wetness;
};

RG_FN uint wet_normal_snorm12(float v)
{
    return rg_to_uint(rg_to_int(rg_floor(rg_clamp(v, -1.0f, 1.0f) * 2047.0f + 2048.5f)));
}

RG_FN uint wet_normal_pack(float x, float y, float wetness)
{
    uint w = rg_to_uint(rg_to_int(rg_clamp(wetness, 0.0f, 1.0f) * 255.0f + 0.5f));
    return wet_normal_snorm12(x) | (wet_normal_snorm12(y) << 12) | (w << 24);
}

RG_FN wet_normal wet_normal_unpack(uint bits)
{
    wet_normal n;
    n.x = rg_to_float(rg_to_int(bits & 0xfffu));
    n.y = rg_to_float(rg_to_int((bits >> 12) & 0xfffu));
    n.wetness = rg_to_float(rg_to_int(bits >> 24));
    return n;
}

RG_FN wet_normal wet_normal_lerp(wet_normal a, wet_normal b, float t)
{
    wet_normal n;
    n.x = a.x + (b.x - a.x) * t;
    n.y = a.y + (b.y - a.y) * t;
    n.wetness = a.wetness + (b.wetness - a.wetness) * t;
    return n;
}

RG_FN float wet_normal_component(float stored)
{
    return (stored - 2048.0f) * (1.0f / 2047.0f);
}

// 0 dry, 1 wet.
RG_FN float wet_normal_wetness(wet_normal n)
{
    return n.wetness * (1.0f / 255.0f);
}

#endif
