// A corner of an item, in clip space.
#ifndef RG_KERNELS_DIALECT_CORNER_H
#define RG_KERNELS_DIALECT_CORNER_H

#include "kernels/dialect/lang.h"

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
