// The surface that the camera sees, between the texels of the depth map: within a face depth is a
// plane over the screen, so it goes on from a texel's middle as it does towards the neighbour that
// differs least, which keeps it on this side of an edge.
#ifndef RG_KERNELS_CARTOON_RAIN_HIT_SURFACE_H
#define RG_KERNELS_CARTOON_RAIN_HIT_SURFACE_H

#include "kernels/cartoon/rain/view.h"

RG_FN float cartoon_slope(float before, float here, float after)
{
    float back = here - before;
    float on = after - here;
    return rg_abs(back) < rg_abs(on) ? back : on;
}

RG_FN float cartoon_depth_of(rg_ctx rg, cartoon_rain_params p, float x_px, float y_px)
{
    int x = rg_iclamp(rg_to_int(rg_floor(x_px)), 0, p.width - 1);
    int y = rg_iclamp(rg_to_int(rg_floor(y_px)), 0, p.height - 1);
    float here = depth_map_texel(rg, x, y, 0, 0).r;
    float across = cartoon_slope(depth_map_texel(rg, rg_imax(x - 1, 0), y, 0, 0).r, here,
                                 depth_map_texel(rg, rg_imin(x + 1, p.width - 1), y, 0, 0).r);
    float down = cartoon_slope(depth_map_texel(rg, x, rg_imax(y - 1, 0), 0, 0).r, here,
                               depth_map_texel(rg, x, rg_imin(y + 1, p.height - 1), 0, 0).r);
    return here + (x_px - rg_to_float(x) - 0.5f) * across + (y_px - rg_to_float(y) - 0.5f) * down;
}

// How far a point lies behind the surface, along the view; below 0 before it.
RG_FN float cartoon_behind_m(rg_ctx rg, cartoon_rain_params p, cartoon_spot s)
{
    float depth = cartoon_depth_of(rg, p, s.x_px, s.y_px);
    float surface_m = p.depth_by / rg_min(depth - p.depth_at, -1e-6f);
    return s.distance_m - surface_m;
}

#endif
