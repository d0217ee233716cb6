// flow's panes as items: a quad each, with its own frame in the world. The programs that draw panes
// include this file; item.h has the functions that read their slots.
#ifndef RG_KERNELS_FLOW_PANES_PANES_H
#define RG_KERNELS_FLOW_PANES_PANES_H

#include "kernels/flow/water/water.h"
#include "kernels/flow/panes/view_params.h"
#include "kernels/dialect/math.h"
#include "kernels/flow/panes/normal_map.h"
#include "kernels/dialect/draw/triangle.h"

RG_STRUCT(flow_pane_record)
{
    rg_planes planes; // of the corners top left, top right, bottom left
    int first;        // index of the pane's texel (0, 0)
    float facing;     // 1: seen from outside; -1: from inside the box
    v3 t;
    v3 b;
    v3 n;
};
RG_STRUCT_SIZE(flow_pane_record, 27)

// A point of a pane: 0 to 1 from left to right and from top to bottom.
RG_STRUCT(flow_point)
{
    float u;
    float v;
};

RG_FN flow_point flow_point_at(rg_planes s, int px, int py)
{
    flow_point at;
    float dx = rg_to_float(px) + 0.5f - s.origin_x;
    float dy = rg_to_float(py) + 0.5f - s.origin_y;
    float w = rg_planes_w(s, px, py);
    // pane_item's second corner lies below the first.
    at.u = RG_INTERPOLATED(rg_at.y, rg_clamp(rg_plane_at(s.b, dx, dy) * w, 0.0f, 1.0f));
    at.v = RG_INTERPOLATED(rg_at.x, rg_clamp(rg_plane_at(s.c, dx, dy) * w, 0.0f, 1.0f));
    return at;
}

// Whether a point lies on the bar along the pane's edges.
RG_FN bool flow_on_frame(flow_point at, float frame)
{
    return rg_min(rg_min(at.u, 1.0f - at.u), rg_min(at.v, 1.0f - at.v)) < frame;
}

// The Fresnel term of a view along `ray` onto a surface that it meets with `towards` = ray .
// normal, which is negative (Fernando & Kilgard, The Cg Tutorial, p. 189).
RG_FN float flow_fresnel(flow_view_params p, v3 ray, float towards)
{
    float grazing = rg_clamp(1.0f + towards / rg_sqrt(v3_dot(ray, ray)), 0.0f, 1.0f);
    return rg_min(p.fresnel_bias + p.fresnel_scale * rg_pow_whole(grazing, p.fresnel_power), 1.0f);
}

#endif
