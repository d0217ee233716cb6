// Matrices of four rows, by value. A row's dot product is written out, so that all devices round
// alike.
#ifndef RG_KERNELS_DIALECT_MATRIX_H
#define RG_KERNELS_DIALECT_MATRIX_H

#include "kernels/dialect/vec.h"

// Row-major: x' = xx x + xy y + xz z + xw, and so on.
RG_STRUCT(m4)
{
    float xx, xy, xz, xw;
    float yx, yy, yz, yw;
    float zx, zy, zz, zw;
    float wx, wy, wz, ww;
};
RG_STRUCT_SIZE(m4, 16)

// A point taken to clip space.
RG_FN rg_corner m4_project(m4 m, v3 p)
{
    return rg_corner_make(
        m.xx * p.x + m.xy * p.y + m.xz * p.z + m.xw, m.yx * p.x + m.yy * p.y + m.yz * p.z + m.yw,
        m.zx * p.x + m.zy * p.y + m.zz * p.z + m.zw, m.wx * p.x + m.wy * p.y + m.wz * p.z + m.ww);
}

// A direction turned by the matrix's first three rows and columns.
RG_FN v3 m4_turn(m4 m, v3 d)
{
    return v3_make(m.xx * d.x + m.xy * d.y + m.xz * d.z, m.yx * d.x + m.yy * d.y + m.yz * d.z,
                   m.zx * d.x + m.zy * d.y + m.zz * d.z);
}

#endif
