// raster: streaks of falling drops in a box of air ahead of the eye, as billboards that turn about
// their axis towards the eye. The item has no branches, so that compilers run several side by side.
#include "kernels/raster/streaks_params.h"
#include "kernels/dialect/vec.h"

#define RG_PARAMS  raster_streaks_params
#define RG_SLOTS   IN(1, float, drops)
#define RG_CORNERS 4

RG_STRUCT(raster_streak)
{
    float depth;
};
#define RG_RECORD raster_streak
#include "kernels/dialect/draw/draw.h"

// A coordinate of a drop that has fallen so far, in boxes; a drop that leaves below comes in again
// above.
RG_FN float raster_wrapped(float start, float fallen)
{
    float now = start + fallen;
    return now - rg_floor(now);
}

RG_FN v3 raster_head(rg_ctx rg, raster_streaks_params p, int i)
{
    return v3_make(p.corner_x + p.size_x * raster_wrapped(drops_at(rg, i), p.fallen_x),
                   p.corner_y + p.size_y * raster_wrapped(drops_at(rg, p.count + i), p.fallen_y),
                   p.corner_z +
                       p.size_z * raster_wrapped(drops_at(rg, 2 * p.count + i), p.fallen_z));
}

// The vector from a streak's axis to its rim, across the axis as the eye sees it.
RG_FN v3 raster_side(v3 head, v3 streak, float radius_m)
{
    v3 beside = v3_cross(streak, head);
    return v3_scale(beside, radius_m / rg_sqrt(rg_max(v3_dot(beside, beside), 1e-12f)));
}

RG_FN rg_corner raster_to_clip(raster_streaks_params p, v3 v)
{
    return rg_corner_make(p.scale_x * v.x, p.scale_y * v.y, p.depth_scale * v.z + p.depth_offset,
                          v.z);
}

RG_DRAW_ITEM(raster_streaks)
{
    v3 head = raster_head(rg, p, i);
    v3 streak = v3_make(p.streak_x, p.streak_y, p.streak_z);
    v3 tail = v3_add(head, streak);
    v3 side = raster_side(head, streak, p.radius_m);
    v3 other = v3_scale(side, -1.0f);
    rg_item t;
    t.alive = 1;
    t.a = raster_to_clip(p, v3_add(head, side));
    t.b = raster_to_clip(p, v3_add(tail, side));
    t.c = raster_to_clip(p, v3_add(tail, other));
    t.d = raster_to_clip(p, v3_add(head, other));
    return t;
}

RG_DRAW_RECORD(raster_streaks)
{
    rg_corner head = raster_to_clip(p, raster_head(rg, p, i));
    raster_streak r;
    r.depth = head.z / rg_max(head.w, RG_LEAST_W);
    return r;
}

RG_DRAW_FRAGMENT(raster_streaks)
{
    return rg_fragment_make(rg_rgba(p.light, p.light, p.light, p.opacity), r.depth);
}
