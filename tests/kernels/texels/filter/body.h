// The common part of these files, each of which defines RG_SLOTS: reads an image between its
// texels. Elements of `at` are u, v, the layer and the level.
#include "tests/kernels/texels/filter/params.h"

#define RG_PARAMS test_filter_params
#include "kernels/dialect/slots/slots.h"

RG_PROC void test_filter(rg_ctx rg, test_filter_params p, int x)
{
    rgba at = at_at(rg, x);
    int layer = rg_to_int(at.b);
    rgba c = source_trilinear(rg, at.r, at.g, layer, at.a);
    if (p.filtering == TEST_FILTER_NEAREST)
        c = source_nearest(rg, at.r, at.g, layer, rg_to_int(at.a));
    if (p.filtering == TEST_FILTER_LINEAR)
        c = source_linear(rg, at.r, at.g, layer, rg_to_int(at.a));
    colours_put(rg, x, c);
}
