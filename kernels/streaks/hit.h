// The surface that rain hits: the scene seen along the fall. Programs and kernels include this file
// after their slots, which have
//   IMAGE(n, D32F, depths)
#ifndef RG_KERNELS_STREAKS_HIT_H
#define RG_KERNELS_STREAKS_HIT_H

#include "kernels/streaks/params.h"

// Returns truth values as numbers, which gcc can turn into masks.
RG_FN int streaks_below(float a, float b)
{
    return a < b ? 1 : 0;
}

// A texel of a map of the scene seen along the fall, and whether the place lies beyond the map.
RG_STRUCT(streaks_map_place)
{
    int x;
    int y;
    int outside;
};

// The texel of a place in a map of this size. All maps have one extent.
RG_FN streaks_map_place streaks_map_place_at(streaks_params p, float x, float y, int texels_x,
                                             int texels_y)
{
    float width = rg_to_float(texels_x);
    float height = rg_to_float(texels_y);
    float u = (x - p.map_x) * p.map_per_x * width;
    float v = (y - p.map_y) * p.map_per_y * height;
    streaks_map_place t;
    t.x = rg_to_int(rg_clamp(u, 0.0f, width - 1.0f));
    t.y = rg_to_int(rg_clamp(v, 0.0f, height - 1.0f));
    t.outside = streaks_below(u, 0.0f) | streaks_below(v, 0.0f) | streaks_below(width, u) |
                streaks_below(height, v);
    return t;
}

// s of the first surface at a place, or of the ground off the map. A sum of products with 0 and 1
// makes the choice, because gcc would move the load that only one side needs into a branch.
RG_FN float streaks_hit(rg_ctx rg, streaks_params p, streaks_map_place at)
{
    float depth = depths_texel(rg, at.x, at.y, 0, 0).r;
    float inside = rg_to_float(1 - at.outside);
    return inside * (p.map_top + depth * p.map_height) + (1.0f - inside) * p.ground;
}

#endif
