// The share of the sky that is seen from a place of the scene, on a grid of 4 m. A word holds four
// neighbours, so that interpolation between eight points takes two words. Programs include this
// file after their slots, which have IN(n, uint, openness).
#ifndef RG_KERNELS_SCENERY_OPENNESS_H
#define RG_KERNELS_SCENERY_OPENNESS_H

#include "kernels/scenery/openness_grid.h"
#include "kernels/dialect/vec.h"

// Interpolates between the four points of a level, 0 to 255.
RG_FN float scenery_openness_level(rg_ctx rg, int x, int z, int level, float fx, float fz)
{
    uint four = openness_at(rg, (level * SCENERY_OPEN_SIDE + z) * SCENERY_OPEN_SIDE + x);
    float a = rg_to_float(four & 255u);
    float b = rg_to_float((four >> 8) & 255u);
    float c = rg_to_float((four >> 16) & 255u);
    float d = rg_to_float(four >> 24);
    float near = a + (b - a) * fx;
    float far = c + (d - c) * fx;
    return near + (far - near) * fz;
}

// The openness at a place in the world, 0 to 1.
RG_FN float scenery_openness(rg_ctx rg, v3 at)
{
    float side = rg_to_float(SCENERY_OPEN_SIDE - 1);
    float x = rg_clamp((at.x - SCENERY_OPEN_LOW_M) * (1.0f / SCENERY_OPEN_CELL_M), 0.0f, side);
    float z = rg_clamp((at.z - SCENERY_OPEN_LOW_M) * (1.0f / SCENERY_OPEN_CELL_M), 0.0f, side);
    float y = rg_clamp(at.y * (1.0f / SCENERY_OPEN_CELL_M), 0.0f,
                       rg_to_float(SCENERY_OPEN_LEVELS - 1) - 0.001f);
    // Floors as floats before rg_to_int; else gcc makes branches of the clamps, and no vectors.
    float lx = rg_floor(x);
    float lz = rg_floor(z);
    float ly = rg_floor(y);
    int ix = rg_to_int(lx);
    int iz = rg_to_int(lz);
    int iy = rg_to_int(ly);
    float fx = x - lx;
    float fz = z - lz;
    float lower = scenery_openness_level(rg, ix, iz, iy, fx, fz);
    float upper = scenery_openness_level(rg, ix, iz, iy + 1, fx, fz);
    return (lower + (upper - lower) * (y - ly)) * (1.0f / 255.0f);
}

#endif
