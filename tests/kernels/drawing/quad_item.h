// Quads of a buffer as items. Programs with IN(1, float, quads), of TEST_QUAD_WORDS words each,
// include it after kernels/dialect/draw/draw.h.
#ifndef RG_TESTS_KERNELS_QUAD_ITEM_H
#define RG_TESTS_KERNELS_QUAD_ITEM_H

RG_FN rg_corner test_corner(rg_ctx rg, int i, int k)
{
    int at = i * TEST_QUAD_WORDS + 4 * k;
    return rg_corner_make(quads_at(rg, at), quads_at(rg, at + 1), quads_at(rg, at + 2),
                          quads_at(rg, at + 3));
}

RG_FN rg_item test_quad_item(rg_ctx rg, int i)
{
    rg_item t;
    t.alive = 1;
    t.a = test_corner(rg, i, 0);
    t.b = test_corner(rg, i, 1);
    t.c = test_corner(rg, i, 2);
    t.d = test_corner(rg, i, 3);
    return t;
}

RG_FN rgba test_quad_colour(rg_ctx rg, int i)
{
    int at = i * TEST_QUAD_WORDS + 16;
    return rg_rgba(quads_at(rg, at), quads_at(rg, at + 1), quads_at(rg, at + 2),
                   quads_at(rg, at + 3));
}

RG_FN float test_quad_depth(rg_ctx rg, int i)
{
    return rg_abs(quads_at(rg, i * TEST_QUAD_WORDS + 2));
}

#endif
