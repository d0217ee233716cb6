// For tests: quads of quads.h in the light of points and suns, through maps of depth and of halves.
#include "tests/kernels/drawing/lights_params.h"
#include "tests/kernels/drawing/quads_params.h"

#define RG_PARAMS test_lights_params
#define RG_SLOTS                                                                                   \
    IN(1, float, quads)                                                                            \
    IN(2, test_light, lights) IMAGE(3, D32F, shadows) SAMPLED(4, R16F, gobos, FILTERED)
#define RG_CORNERS 4
#define RG_LIGHTS  1

RG_STRUCT(test_lit_quad)
{
    rgba colour;
    v3 normal;
    float depth;
    float slope;
};
#define RG_RECORD test_lit_quad

// The part of a light that depends on a quad alone. With TEST_LIGHT_RECORDS devices keep it,
// otherwise each pixel calculates it anew; the pictures are the same.
RG_STRUCT(test_quad_light)
{
    float near; // 0 for a sun
    float facing_x, facing_y, facing_z;
};
#if defined(TEST_LIGHT_RECORDS)
#define RG_LIGHT_RECORD test_quad_light
#endif
#include "kernels/dialect/draw/draw.h"

#include "kernels/dialect/math.h"
#include "tests/kernels/drawing/quad_item.h"

RG_DRAW_ITEM(test_lights)
{
    return test_quad_item(rg, i);
}

RG_DRAW_RECORD(test_lights)
{
    test_lit_quad r;
    r.colour = test_quad_colour(rg, i);
    r.normal = v3_unit(v3_make(r.colour.r - 0.5f, r.colour.g - 0.5f, r.colour.b + 0.5f));
    r.depth = test_quad_depth(rg, i);
    r.slope = r.colour.g * 0.001f;
    return r;
}

RG_FN float test_depth(test_lit_quad r, int px, int py)
{
    return r.depth + r.slope * rg_to_float(px - py);
}

// The share of a light that its maps let through.
RG_FN float test_let_through(rg_ctx rg, test_light l, v3 at)
{
    rg_corner c = m4_project(l.to_map, at);
    float w = rg_max(c.w, 0.01f);
    float u = c.x / w;
    float v = c.y / w;
    int layer = rg_imax(l.layer, 0);
    float nearest = shadows_nearest(rg, u, v, layer, 0).r;
    float through = gobos_trilinear(rg, u, v, layer, c.z).r;
    float seen = c.z / w - l.bias < nearest ? through : 0.125f;
    return l.layer < 0 ? 1.0f : seen;
}

RG_FN test_quad_light test_quad_light_of(rg_ctx rg, test_lights_params p, test_lit_quad r,
                                         int light)
{
    test_light l = lights_at(rg, p.first + light);
    float reach = l.kind == TEST_LIGHT_POINT ? l.reach : 1.0f;
    test_quad_light by;
    by.near = l.kind == TEST_LIGHT_POINT ? 1.0f : 0.0f;
    by.facing_x = r.normal.x * reach;
    by.facing_y = r.normal.y * reach;
    by.facing_z = r.normal.z * reach;
    return by;
}

#if defined(TEST_LIGHT_RECORDS)
RG_DRAW_RECORD_LIGHT(test_lights)
{
    return test_quad_light_of(rg, p, r, light);
}
#endif

RG_DRAW_LIGHT(test_lights)
{
#if !defined(TEST_LIGHT_RECORDS)
    test_quad_light by = test_quad_light_of(rg, p, r, light);
#endif
    test_light l = lights_at(rg, p.first + light);
    v3 at = v3_make(rg_to_float(px) * p.px_to_unit, rg_to_float(py) * p.px_to_unit,
                    test_depth(r, px, py));
    v3 towards = v3_add(l.at, v3_scale(at, -by.near));
    float squared = v3_dot(towards, towards) + 0.01f;
    v3 normal = v3_make(by.facing_x, by.facing_y, by.facing_z);
    float facing = rg_max(v3_dot(towards, normal), 0.0f) / rg_sqrt(squared);
    float fading = l.kind == TEST_LIGHT_POINT ? 1.0f / squared : 1.0f;
    float share = facing * fading * test_let_through(rg, l, at);
    return rg_rgba(l.colour.r * share, l.colour.g * share, l.colour.b * share, share);
}

RG_DRAW_FRAGMENT(test_lights)
{
    float own = p.plain == 1 ? 0.0f : 1.0f;
    rgba c = rg_rgba(lit.r * (r.colour.r * own + (1.0f - own)) + 0.01f * own,
                     lit.g * (r.colour.g * own + (1.0f - own)),
                     lit.b * (r.colour.b * own + (1.0f - own)),
                     p.plain == 1 ? lit.a : rg_min(r.colour.a * lit.a, 1.0f));
    rg_fragment f = rg_fragment_make(c, test_depth(r, px, py));
    f.kept = ((px ^ py) & 15) == 15 ? 0 : 1;
    return f;
}
