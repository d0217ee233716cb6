// Quads of given corners in clip space, in given colours: for tests.
#include "test_quads_params.h"

#define RG_PARAMS  test_quads_params
#define RG_SLOTS   IN(1, float, quads)
#define RG_CORNERS 4
#include "lang.h"

RG_STRUCT(test_quad)
{
    rgba colour;
    float depth;
    int item;
};
#define RG_RECORD test_quad
#include "draw.h"

RG_FN rg_corner test_corner(rg_ctx rg, int i, int k)
{
    int at = i * TEST_QUAD_WORDS + 4 * k;
    return rg_corner_make(quads_at(rg, at), quads_at(rg, at + 1), quads_at(rg, at + 2),
                          quads_at(rg, at + 3));
}

RG_DRAW_ITEM(test_quads)
{
    rg_item t;
    t.alive = 1;
    t.a = test_corner(rg, i, 0);
    t.b = test_corner(rg, i, 1);
    t.c = test_corner(rg, i, 2);
    t.d = test_corner(rg, i, 3);
    return t;
}

RG_DRAW_RECORD(test_quads)
{
    int at = i * TEST_QUAD_WORDS + 16;
    test_quad r;
    r.colour =
        rg_rgba(quads_at(rg, at), quads_at(rg, at + 1), quads_at(rg, at + 2), quads_at(rg, at + 3));
    r.depth = rg_abs(quads_at(rg, i * TEST_QUAD_WORDS + 2));
    r.item = i;
    return r;
}

RG_DRAW_FRAGMENT(test_quads)
{
    float x = rg_to_float(px);
    float y = rg_to_float(py);
    float shade = rg_to_float((px + 3 * py + r.item) & 7) * p.gradient;
    rgba c = rg_rgba(r.colour.r + shade, r.colour.g + shade, r.colour.b, r.colour.a);
    rg_fragment f = rg_fragment_make(c, r.depth + x * p.slope_x + y * p.slope_y);
    f.kept = ((px ^ py ^ r.item) & 15) == 15 ? 0 : 1;
    return f;
}
