// Quads, some of them plain. Fragments show whether they were drawn as plain ones, which real
// programs must not show: tests see by it where that is so.
#include "tests/kernels/drawing/quads_params.h"

#define RG_PARAMS  test_quads_params
#define RG_SLOTS   IN(1, float, quads)
#define RG_CORNERS 4
#include "kernels/dialect/lang.h"

RG_STRUCT(test_plain)
{
    int item;
};
#define RG_RECORD test_plain
#define RG_PLAIN
#include "kernels/dialect/draw/draw.h"

#include "tests/kernels/drawing/quad_item.h"

RG_DRAW_ITEM(test_plain)
{
    return test_quad_item(rg, i);
}

RG_DRAW_RECORD(test_plain)
{
    test_plain r;
    r.item = i;
    return r;
}

RG_DRAW_PLAIN(test_plain)
{
    return r.item % 3 == 0 ? 1 : 0;
}

RG_DRAW_FRAGMENT(test_plain)
{
    float taken = rg_to_float(rg_all_plain(rg));
    return rg_fragment_make(rg_rgba(rg_to_float(r.item), taken, 0.0f, 1.0f), 0.5f);
}
