// The lit pane, seen from inside. Light goes straight through the glass, which is thin. The water
// on its far side is flat against the glass and curved outside; both surfaces bend and reflect
// light.
#include "kernels/drops/view/colour.h"
#include "kernels/drops/view/pane_params.h"

#define RG_PARAMS drops_pane_params
#define RG_SLOTS                                                                                   \
    IN(1, float, height)                                                                           \
    SAMPLED(2, RG11B10F, environment, CUBE) SAMPLED(3, RGBA16F, background, FILTERED)
#include "kernels/dialect/draw/view_quad.h"

#include "kernels/dialect/dielectric.h"
#include "kernels/drops/view/outside.h"
#include "kernels/drops/view/surface.h"

RG_DRAW_ITEM(drops_pane)
{
    return view_quad();
}

RG_DRAW_RECORD(drops_pane)
{
    return view_quad_record();
}

// The light that the viewer sees along `d` through water of this surface. Each of its two surfaces
// reflects a share; the outer one's reflection does not meet the drop again.
RG_FN v3 through_water(rg_ctx rg, drops_pane_params p, float x_mm, float y_mm, v3 d,
                       drops_surface s, float spread_rad)
{
    float into = 1.0f / p.index;
    float ahead = -d.z;
    float ahead_in = rg_sqrt(rg_max(rg_cos_refracted2(ahead, into), 0.0f));
    v3 inside = v3_make(d.x * into, d.y * into, -ahead_in);
    v3 normal = v3_unit(v3_make(-s.slope_x, -s.slope_y, -1.0f));
    float cos_in = rg_clamp(v3_dot(inside, normal), 0.0f, 1.0f);
    float cos_out2 = rg_cos_refracted2(cos_in, p.index);
    float cos_out = rg_sqrt(rg_max(cos_out2, 0.0f));
    float kept = cos_out2 > 0.0f ? rg_reflectance(cos_in, cos_out, p.index) : 1.0f;
    v3 outside =
        v3_unit(v3_add(v3_scale(inside, p.index), v3_scale(normal, cos_out - p.index * cos_in)));
    float mirrored = rg_reflectance(ahead, ahead_in, into);
    v3 front = drops_light_from(rg, p, x_mm, y_mm, v3_make(d.x, d.y, ahead), spread_rad);
    v3 back = drops_light_from(rg, p, x_mm, y_mm, v3_add(inside, v3_scale(normal, -2.0f * cos_in)),
                               spread_rad);
    v3 passed = drops_light_from(rg, p, x_mm, y_mm, outside, spread_rad);
    return v3_add(v3_scale(front, mirrored),
                  v3_add(v3_scale(back, (1.0f - mirrored) * kept),
                         v3_scale(passed, (1.0f - mirrored) * (1.0f - kept))));
}

// The light that the ray through a place on the pane meets.
RG_FN v3 seen_at(rg_ctx rg, drops_pane_params p, float x_mm, float y_mm)
{
    v3 d = v3_unit(v3_make(x_mm - p.middle_x_mm, y_mm - p.middle_y_mm, -p.distance_mm));
    drops_surface s = drops_surface_at(rg, p.stride, p.columns, p.rows, p.cell_mm, x_mm, y_mm);
    float step_mm = p.mm_px / rg_to_float(p.rays);
    float spread_rad = step_mm / p.distance_mm;
    v3 light;
    if (s.height > p.contact_mm)
        light = through_water(rg, p, x_mm, y_mm, d, s,
                              spread_rad + step_mm * (p.index - 1.0f) * s.bend);
    else
        light = drops_light_from(rg, p, x_mm, y_mm, d, spread_rad);
    return light;
}

RG_DRAW_FRAGMENT(drops_pane)
{
    float step_px = 1.0f / rg_to_float(p.rays);
    float right = rg_to_float(p.columns) * p.cell_mm;
    float bottom = rg_to_float(p.rows) * p.cell_mm;
    rgba beside = DROPS_BESIDE;
    v3 sum = v3_make(0.0f, 0.0f, 0.0f);
    for (int ray = 0; ray < p.rays * p.rays; ray++) {
        float x = rg_to_float(px) + (rg_to_float(ray % p.rays) + 0.5f) * step_px;
        float y = rg_to_float(py) + (rg_to_float(ray / p.rays) + 0.5f) * step_px;
        float x_mm = p.left_mm + x * p.mm_px;
        float y_mm = p.top_mm + y * p.mm_px;
        v3 light = v3_make(beside.r, beside.g, beside.b);
        if (x_mm >= 0.0f && x_mm < right && y_mm >= 0.0f && y_mm < bottom)
            light = seen_at(rg, p, x_mm, y_mm);
        sum = v3_add(sum, light);
    }
    float share = step_px * step_px;
    return rg_fragment_make(rg_rgba(sum.x * share, sum.y * share, sum.z * share, 1.0f), 1.0f);
}
