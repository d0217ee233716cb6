// flow: mirrors without their water: the environment in the mirrored view's direction. Water on
// them shows this picture displaced.
#include "kernels/flow/panes/panes.h"
#include "kernels/dialect/math.h"

#define RG_PARAMS  flow_view_params
#define RG_SLOTS   SAMPLED(1, RG11B10F, environment, CUBE) IN(2, flow_pane, panes)
#define RG_CORNERS 4
#define RG_RECORD  flow_pane_record
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/image/cube_light.h"
#include "kernels/flow/panes/item.h"

RG_DRAW_ITEM(flow_dry_mirror)
{
    return pane_item(rg, p.to_clip, i);
}

RG_DRAW_RECORD(flow_dry_mirror)
{
    return pane_record(rg, draw, p, i);
}

RG_DRAW_FRAGMENT(flow_dry_mirror)
{
    v3 ray = m4_turn(p.rays, v3_make(rg_to_float(px), rg_to_float(py), 1.0f));
    v3 light =
        v3_scale(light_from(rg, v3_reflect(ray, r.n), 0, p.environment_size), p.reflectivity);
    return rg_fragment_make(rg_rgba(light.x, light.y, light.z, 1.0f),
                            rg_planes_depth(r.planes, px, py));
}
