// The height of the scene at a place, by its depth map from above.
#ifndef RG_KERNELS_SHOWER_HEIGHTS_H
#define RG_KERNELS_SHOWER_HEIGHTS_H

#include "kernels/shower/params.h"

// A texel of the scene seen from above; `outside` is 1 for places off the map.
RG_STRUCT(shower_map_place)
{
    int x;
    int z;
    int outside;
};

RG_FN shower_map_place shower_map_place_at(shower_params p, float x, float z, int width, int height)
{
    float u = (x - p.map_x) * p.map_per_x * rg_to_float(width);
    float v = (z - p.map_z) * p.map_per_z * rg_to_float(height);
    shower_map_place m;
    m.x = rg_to_int(rg_floor(rg_clamp(u, 0.0f, rg_to_float(width - 1))));
    m.z = rg_to_int(rg_floor(rg_clamp(v, 0.0f, rg_to_float(height - 1))));
    m.outside = (u < 0.0f ? 1 : 0) | (v < 0.0f ? 1 : 0) | (u >= rg_to_float(width) ? 1 : 0) |
                (v >= rg_to_float(height) ? 1 : 0);
    return m;
}

// The height of the scene, by its depth seen from above. A sum of products with 0 and 1 makes the
// choice, because gcc would move the load that only one side needs into a branch.
RG_FN float shower_height(shower_params p, float depth, int outside)
{
    float seen = rg_max(p.map_top_m - depth * p.map_height_m, p.ground_m);
    float beyond = rg_to_float(outside);
    return (1.0f - beyond) * seen + beyond * p.ground_m;
}

#endif
