// A depth map in a corner of the picture: near is white, and so is its frame.
#include "kernels/scenery/overlay/inset_params.h"

#define RG_PARAMS scenery_inset_params
#define RG_SLOTS  IMAGE(1, D32F, map)
#include "kernels/dialect/draw/view_quad.h"

RG_DRAW_ITEM(streaks_inset)
{
    return view_quad();
}

RG_DRAW_RECORD(streaks_inset)
{
    return view_quad_record();
}

RG_DRAW_FRAGMENT(streaks_inset)
{
    float across = (rg_to_float(px - p.x0) + 0.5f) / rg_to_float(p.x1 - p.x0);
    float down = (rg_to_float(py - p.y0) + 0.5f) / rg_to_float(p.y1 - p.y0);
    float depth =
        map_nearest(rg, p.u0 + (p.u1 - p.u0) * across, p.v0 + (p.v1 - p.v0) * down, p.layer, 0).r;
    float grey = rg_clamp((depth - p.far_depth) / (p.near_depth - p.far_depth), 0.0f, 1.0f);
    int frame = (px == p.x0 ? 1 : 0) | (px == p.x1 - 1 ? 1 : 0) | (py == p.y0 ? 1 : 0) |
                (py == p.y1 - 1 ? 1 : 0);
    float shown = frame != 0 ? 1.0f : grey;
    return rg_fragment_make(rg_rgba(shown, shown, shown, 1.0f), 0.0f);
}
