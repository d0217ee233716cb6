// For tests: quads of given corners in clip space, in given colours.
#include "tests/kernels/drawing/quads_params.h"

#define RG_PARAMS  test_quads_params
#define RG_SLOTS   IN(1, float, quads)
#define RG_CORNERS 4
#include "kernels/dialect/lang.h"

RG_STRUCT(test_quad)
{
    rgba colour;
    float depth;
    int item;
};
#define RG_RECORD test_quad
#include "kernels/dialect/draw/draw.h"

#include "tests/kernels/drawing/quad_item.h"

RG_DRAW_ITEM(test_quads)
{
    return test_quad_item(rg, i);
}

RG_DRAW_RECORD(test_quads)
{
    test_quad r;
    r.colour = test_quad_colour(rg, i);
    r.depth = test_quad_depth(rg, i);
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
