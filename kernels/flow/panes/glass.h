// flow: panes of glass, blended over what lies behind them. Glass and water reflect the environment
// by the Fresnel model (section 4.3). Water shows the picture behind it, of all that does not
// refract, displaced by its normal (GPU Gems 2, chapter 19).
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

RG_DRAW_ITEM(flow_glass)
{
    return pane_item(rg, p.to_clip, i);
}

RG_DRAW_RECORD(flow_glass)
{
    return pane_record(rg, draw, p, i);
}

RG_DRAW_FRAGMENT(flow_glass)
{
    flow_point at = flow_point_at(r.planes, px, py);
    flow_water water = water_on(rg, r, p.size, at);
    v3 ray = m4_turn(p.rays, v3_make(rg_to_float(px), rg_to_float(py), 1.0f));
    float towards = v3_dot(ray, water.normal);
    float reflectance = flow_fresnel(p, ray, towards);
    v3 mirrored = v3_add(ray, v3_scale(water.normal, -2.0f * towards));
    v3 light = light_from(rg, mirrored, p.reflection_level, p.reflection_size);
    rgba through = seen_through(rg, p, water.bend, px, py);
    float kept = (1.0f - reflectance) * water.wetness;
    float alpha = reflectance + kept;
    float bar = flow_on_frame(at, p.frame) ? 1.0f : 0.0f;
    float shown = 1.0f - 0.94f * bar;
    rgba c = rg_rgba((light.x * reflectance + through.r * kept) * shown,
                     (light.y * reflectance + through.g * kept) * shown,
                     (light.z * reflectance + through.b * kept) * shown, rg_max(alpha, bar));
    return rg_fragment_make(c, rg_planes_depth(r.planes, px, py));
}
