// flow: mirrors with their water. Water reflects the environment at its own normal by the Fresnel
// model (section 4.3), and shows the dry mirrors (dry_mirror.h) displaced by the normal (GPU Gems
// 2, chapter 19).
#include "kernels/flow/panes/panes.h"
#include "kernels/dialect/math.h"

#define RG_PARAMS flow_view_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, normals)                                                                           \
    SAMPLED(2, RG11B10F, environment, CUBE)                                                        \
    IN(3, flow_pane, panes) SAMPLED(4, RGBA16F, behind, FILTERED)
#define RG_CORNERS 4
#define RG_RECORD  flow_pane_record
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/image/cube_light.h"
#include "kernels/flow/panes/behind.h"
#include "kernels/flow/panes/item.h"
#include "kernels/flow/panes/surface.h"

RG_DRAW_ITEM(flow_mirror)
{
    return pane_item(rg, p.to_clip, i);
}

RG_DRAW_RECORD(flow_mirror)
{
    return pane_record(rg, draw, p, i);
}

RG_DRAW_FRAGMENT(flow_mirror)
{
    flow_point at = flow_point_at(r.planes, px, py);
    flow_water water = water_on(rg, r, p.size, at);
    v3 ray = m4_turn(p.rays, v3_make(rg_to_float(px), rg_to_float(py), 1.0f));
    float towards = v3_dot(ray, water.normal);
    float reflectance = water.wetness * flow_fresnel(p, ray, towards);
    v3 mirrored = v3_add(ray, v3_scale(water.normal, -2.0f * towards));
    v3 light = light_from(rg, mirrored, p.reflection_level, p.reflection_size);
    rgba through = seen_through(rg, p, water.bend, px, py);
    float kept = 1.0f - reflectance;
    float shown = flow_on_frame(at, p.frame) ? 0.06f : 1.0f;
    rgba c = rg_rgba((light.x * reflectance + through.r * kept) * shown,
                     (light.y * reflectance + through.g * kept) * shown,
                     (light.z * reflectance + through.b * kept) * shown, 1.0f);
    return rg_fragment_make(c, rg_planes_depth(r.planes, px, py));
}
