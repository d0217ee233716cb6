// Vectors of three floats, by value, each operation written out, so that all devices round alike;
// and corners of four floats.
#ifndef RG_KERNELS_DIALECT_VEC_H
#define RG_KERNELS_DIALECT_VEC_H

#include "kernels/dialect/lang.h"

RG_STRUCT(v3)
{
    float x;
    float y;
    float z;
};
RG_STRUCT_SIZE(v3, 3)

RG_FN v3 v3_make(float x, float y, float z)
{
    v3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

RG_FN v3 v3_add(v3 a, v3 b)
{
    return v3_make(a.x + b.x, a.y + b.y, a.z + b.z);
}

RG_FN v3 v3_scale(v3 a, float s)
{
    return v3_make(a.x * s, a.y * s, a.z * s);
}

RG_FN float v3_dot(v3 a, v3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

RG_FN v3 v3_cross(v3 a, v3 b)
{
    return v3_make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

RG_FN v3 v3_unit(v3 a)
{
    return v3_scale(a, 1.0f / rg_sqrt(v3_dot(a, a)));
}

// The direction of a ray along `incident` after its reflection at a mirror with unit normal `n`.
RG_FN v3 v3_reflect(v3 incident, v3 n)
{
    return v3_add(incident, v3_scale(n, -2.0f * v3_dot(incident, n)));
}

// A corner of an item, in clip space.
RG_STRUCT(rg_corner)
{
    float x;
    float y;
    float z;
    float w;
};
RG_STRUCT_SIZE(rg_corner, 4)

RG_FN rg_corner rg_corner_make(float x, float y, float z, float w)
{
    rg_corner c;
    c.x = x;
    c.y = y;
    c.z = z;
    c.w = w;
    return c;
}

#endif
