// A map as a plate in the world, in greys: a density map over the plane where rain begins, or a
// depth map over what it shows.
#include "kernels/dialect/draw/triangle.h"
#include "kernels/scenery/overlay/plate_params.h"

#define RG_PARAMS  scenery_plate_params
#define RG_SLOTS   IMAGE(1, D32F, map)
#define RG_CORNERS 4
#define RG_RECORD  rg_planes
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

RG_FN rg_item scenery_plate_item(scenery_plate_params p)
{
    v3 corner = v3_make(p.corner_x, p.corner_y, p.corner_z);
    v3 down = v3_make(p.down_x, p.down_y, p.down_z);
    v3 beside = v3_add(corner, v3_make(p.across_x, p.across_y, p.across_z));
    rg_item t;
    t.alive = 1;
    t.a = m4_project(p.to_clip, corner);
    t.b = m4_project(p.to_clip, beside);
    t.c = m4_project(p.to_clip, v3_add(beside, down));
    t.d = m4_project(p.to_clip, v3_add(corner, down));
    return t;
}

RG_DRAW_ITEM(streaks_plate)
{
    return scenery_plate_item(p);
}

// The plate's planes over its first, second and last corner: the weights of the last two are the
// place across the map and down.
RG_DRAW_RECORD(streaks_plate)
{
    rg_item t = scenery_plate_item(p);
    t.c = t.d;
    rg_planes planes = rg_planes_of(draw, t);
    planes.nearest = 0.0f; // the fourth corner may be nearer, or farther
    planes.farthest = 1.0f;
    return planes;
}

RG_DRAW_FRAGMENT(streaks_plate)
{
    float dx = rg_to_float(px) + 0.5f - r.origin_x;
    float dy = rg_to_float(py) + 0.5f - r.origin_y;
    float w = rg_planes_w(r, px, py);
    float across = rg_clamp(rg_plane_at(r.b, dx, dy) * w, 0.0f, 1.0f);
    float down = rg_clamp(rg_plane_at(r.c, dx, dy) * w, 0.0f, 1.0f);
    float value = map_nearest(rg, across, down, 0, 0).r;
    float grey = rg_clamp((value - p.black_at) / (p.white_at - p.black_at), 0.0f, 1.0f);
    return rg_fragment_make(rg_rgba(grey, grey, grey, 1.0f), rg_planes_depth(r, px, py));
}
