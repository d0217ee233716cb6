// Light from a direction, by the slots environment and background of the program that includes this
// file. Both are blurred already, as a lens that is focused on the pane sees them.
#ifndef RG_KERNELS_DROPS_VIEW_OUTSIDE_H
#define RG_KERNELS_DROPS_VIEW_OUTSIDE_H

#include "kernels/dialect/image/cube_light.h"
#include "kernels/dialect/math.h"
#include "kernels/drops/view/pane_params.h"

// A place of 0 to 1 in a picture that is mirrored at its edges, over and over.
RG_FN float drops_mirrored(float u)
{
    float t = u - 2.0f * rg_floor(0.5f * u);
    return t > 1.0f ? 2.0f - t : t;
}

// Light from about a direction, which is of unit length and relative to the pane, averaged over
// `spread_rad`.
RG_FN v3 drops_environment(rg_ctx rg, drops_pane_params p, v3 d, float spread_rad)
{
    v3 to = m4_turn(p.to_world, d);
    int last = environment_levels(rg) - 1;
    float texels = spread_rad * rg_to_float(p.environment_px) * 0.63661975f; // 2 / pi
    float lod = rg_clamp(rg_log2(rg_max(texels, 1.0f)), 0.0f, rg_to_float(last));
    int fine = rg_to_int(lod);
    int coarse = rg_imin(fine + 1, last);
    float t = lod - rg_to_float(fine);
    v3 a = light_from(rg, to, fine, p.environment_px >> rg_to_uint(fine));
    if (t > 0.0f) {
        v3 b = light_from(rg, to, coarse, p.environment_px >> rg_to_uint(coarse));
        a = v3_make(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t);
    }
    return a;
}

// Light from the picture behind the pane, seen from a place on the pane; `away` is the direction's
// component away from the viewer.
RG_FN v3 drops_background(rg_ctx rg, drops_pane_params p, float x_mm, float y_mm, v3 d, float away,
                          float spread_rad)
{
    float far = p.background_mm / away;
    float x = x_mm - p.middle_x_mm + d.x * far;
    float y = y_mm - p.middle_y_mm + d.y * far;
    float u = 0.5f + (x * p.right_x + y * p.right_y) * p.per_width;
    float v = 0.5f + (x * p.down_x + y * p.down_y) * p.per_height;
    float texels = spread_rad * far / away * p.texels_mm;
    rgba c = background_trilinear(rg, drops_mirrored(u), drops_mirrored(v), 0,
                                  rg_log2(rg_max(texels, 1.0f)));
    return v3_make(c.r, c.g, c.b);
}

RG_FN v3 drops_light_from(rg_ctx rg, drops_pane_params p, float x_mm, float y_mm, v3 d,
                          float spread_rad)
{
    float away = -d.z;
    v3 light;
    if (p.has_background != 0 && away > 0.02f)
        light = drops_background(rg, p, x_mm, y_mm, d, away, spread_rad);
    else
        light = drops_environment(rg, p, d, spread_rad);
    return light;
}

#endif
