// Quads in groups. Each group has a word: an item whose bit is set says that it is unseen, even if
// it is not. Tests see by it which devices ask.
#include "tests/kernels/drawing/quads_params.h"

#define RG_PARAMS  test_quads_params
#define RG_SLOTS   IN(1, float, quads) IN(2, uint, marks)
#define RG_CORNERS 4
#include "kernels/dialect/lang.h"

RG_STRUCT(test_unseen)
{
    rgba colour;
    float depth;
};
RG_STRUCT(test_marks)
{
    uint unseen; // a bit for each item
};
#define RG_RECORD      test_unseen
#define RG_GROUP       test_marks
#define RG_GROUP_ITEMS 32
#include "kernels/dialect/draw/draw.h"

#include "tests/kernels/drawing/quad_item.h"

RG_DRAW_GROUP(test_unseen)
{
    test_marks m;
    m.unseen = marks_at(rg, number);
    return m;
}

RG_DRAW_UNSEEN(test_unseen)
{
    return rg_to_int((group.unseen >> rg_to_uint(i & 31)) & 1u);
}

RG_DRAW_ITEM(test_unseen)
{
    return test_quad_item(rg, i);
}

RG_DRAW_RECORD(test_unseen)
{
    test_unseen r;
    r.colour = test_quad_colour(rg, i);
    r.depth = test_quad_depth(rg, i);
    return r;
}

RG_DRAW_FRAGMENT(test_unseen)
{
    return rg_fragment_make(r.colour, r.depth);
}
