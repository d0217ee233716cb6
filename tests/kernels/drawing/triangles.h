// For tests: the first three corners of quads.h's quads, bright where they are nearer than an image
// of depth.
#include "tests/kernels/drawing/quads_params.h"
#include "tests/kernels/drawing/triangles_params.h"

#define RG_PARAMS  test_triangles_params
#define RG_SLOTS   IN(1, float, quads) IMAGE(2, D32F, before)
#define RG_CORNERS 3
#include "kernels/dialect/lang.h"

RG_STRUCT(test_triangle)
{
    rgba colour;
    float depth;
};
#define RG_RECORD test_triangle
#include "kernels/dialect/draw/draw.h"

RG_FN rg_corner test_corner(rg_ctx rg, int i, int k)
{
    int at = i * TEST_QUAD_WORDS + 4 * k;
    return rg_corner_make(quads_at(rg, at), quads_at(rg, at + 1), quads_at(rg, at + 2),
                          quads_at(rg, at + 3));
}

RG_DRAW_ITEM(test_triangles)
{
    rg_item t;
    t.alive = 1;
    t.a = test_corner(rg, i, 0);
    t.b = test_corner(rg, i, 1);
    t.c = test_corner(rg, i, 2);
    t.d = t.c;
    return t;
}

RG_DRAW_RECORD(test_triangles)
{
    int at = i * TEST_QUAD_WORDS + 16;
    test_triangle r;
    r.colour =
        rg_rgba(quads_at(rg, at), quads_at(rg, at + 1), quads_at(rg, at + 2), quads_at(rg, at + 3));
    r.depth = rg_abs(quads_at(rg, i * TEST_QUAD_WORDS + 2));
    return r;
}

RG_DRAW_FRAGMENT(test_triangles)
{
    int x = rg_imin(px, before_width(rg, p.level) - 1);
    int y = rg_imin(py, before_height(rg, p.level) - 1);
    float shown = r.depth < before_texel(rg, x, y, p.layer, p.level).r ? 1.0f : 0.25f;
    rgba c = rg_rgba(r.colour.r * shown, r.colour.g * shown, r.colour.b * shown, r.colour.a);
    return rg_fragment_make(c, r.depth);
}
