// flow: an intermediate step, drawn on the panes as in the paper's figure 17: the water's height,
// the blurred height, or the normals.
#include "kernels/flow/panes/panes.h"
#include "kernels/dialect/math.h"

#define RG_PARAMS flow_view_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, normals) IN(2, float, water) IN(3, flow_pane, panes) IN(4, float, blurred)
#define RG_CORNERS 4
#define RG_RECORD  flow_pane_record
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/flow/panes/item.h"
#include "kernels/flow/panes/surface.h"

RG_DRAW_ITEM(flow_stage)
{
    return pane_item(rg, p.to_clip, i);
}

RG_DRAW_RECORD(flow_stage)
{
    return pane_record(rg, draw, p, i);
}

// A height as grey, white from 1 on.
RG_FN rgba shown_height(float height)
{
    float grey = rg_min(height, 1.0f);
    return rg_rgba(grey, grey, grey, 1.0f);
}

RG_DRAW_FRAGMENT(flow_stage)
{
    flow_point at = flow_point_at(r.planes, px, py);
    int last = p.size - 1;
    int x = rg_imin(rg_to_int(at.u * rg_to_float(p.size)), last);
    int y = rg_imin(rg_to_int(at.v * rg_to_float(p.size)), last);
    int i = r.first + y * (p.size + 2 * FLOW_MARGIN) + x;
    wet_normal n = normal_at(rg, i);
    float nx = wet_normal_component(n.x);
    float ny = wet_normal_component(n.y);
    float nz = rg_sqrt(rg_max(1.0f - (nx * nx + ny * ny), 0.0f));
    rgba c = rg_rgba(0.5f * nx + 0.5f, 0.5f * ny + 0.5f, 0.5f * nz + 0.5f, 1.0f);
    if (p.stage == FLOW_SHOWS_HEIGHT)
        c = shown_height(water_at(rg, i));
    if (p.stage == FLOW_SHOWS_BLURRED)
        c = shown_height(blurred_at(rg, i));
    return rg_fragment_make(c, rg_planes_depth(r.planes, px, py));
}
