// For tests: the first three corners of quads.h's quads. A pixel holds the weights of the second
// and the third corner, w, and 1, and the triangle's depth.
#include "tests/kernels/drawing/quads_params.h"

#define RG_PARAMS  test_quads_params
#define RG_SLOTS   IN(1, float, quads)
#define RG_CORNERS 3
#include "kernels/dialect/draw/triangle.h"

RG_STRUCT(test_placed_record)
{
    rg_planes planes;
};
#define RG_RECORD test_placed_record
#include "kernels/dialect/draw/draw.h"

#include "tests/kernels/drawing/quad_item.h"

RG_DRAW_ITEM(test_placed)
{
    rg_item t = test_quad_item(rg, i);
    t.d = t.c;
    return t;
}

RG_DRAW_RECORD(test_placed)
{
    rg_item t = test_quad_item(rg, i);
    t.d = t.c;
    test_placed_record r;
    r.planes = rg_planes_of(draw, t);
    return r;
}

RG_DRAW_FRAGMENT(test_placed)
{
    rg_weights k = rg_planes_weights(r.planes, px, py);
    return rg_fragment_make(rg_rgba(k.b, k.c, rg_planes_w(r.planes, px, py), 1.0f),
                            rg_planes_depth(r.planes, px, py));
}
