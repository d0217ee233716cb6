// Which places of the target a primitive covers, and its values there.
#include "tests/backends/bounding/rig.h"

// --- coverage ---

static void places_near_an_edge_may_be_covered(void **state)
{
    (void)state;
    static const struct {
        double x, y;
        enum rg_cover cover;
    } rows[] = {
        {10.5, 10.5, RG_COVER_YES},  {12.5, 20.5, RG_COVER_YES},   {9.5, 20.5, RG_COVER_NO},
        {20, 20, RG_COVER_MAYBE},    {20.5, 20.5, RG_COVER_NO},    {19.5, 19.5, RG_COVER_YES},
        {10, 15, RG_COVER_MAYBE},    {10.003, 15, RG_COVER_MAYBE}, {10.005, 15, RG_COVER_YES},
        {9.997, 15, RG_COVER_MAYBE}, {9.995, 15, RG_COVER_NO},     {31, 10.002, RG_COVER_NO},
    };
    struct rg_primitive both[2] = {half_square(), half_square()};
    both[1].corners[1] = both[0].corners[2];
    both[1].corners[2] = both[0].corners[1];
    for (int turned = 0; turned < 2; turned++) {
        struct rg_outline outline;
        assert_true(rg_outline_of(scene, &both[turned], &outline));
        assert_int_equal(outline.facing, turned ? -1 : 1);
        for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
            assert_int_equal(rg_outline_cover(&outline, rows[i].x, rows[i].y), rows[i].cover);
    }
}

// Depth from 0.5 w to behind the far plane: half of the triangle is cut off.
static void what_lies_outside_is_clipped(void **state)
{
    (void)state;
    struct rg_outline outline;
    struct rg_primitive cut = half_square();
    cut.corners[1].place[2] = 1.5;
    assert_true(rg_outline_of(scene, &cut, &outline));
    assert_int_equal(outline.count, 4);
    assert_int_equal(rg_outline_cover(&outline, 19.5, 12), RG_COVER_YES);
    assert_int_equal(rg_outline_cover(&outline, 20, 12), RG_COVER_MAYBE);
    assert_int_equal(rg_outline_cover(&outline, 20.5, 12), RG_COVER_NO);
    for (int i = 0; i < 3; i++)
        cut.corners[i].cut = -1;
    assert_false(rg_outline_of(scene, &cut, &outline));
}

// --- attributes ---

static void values_are_those_of_the_plane(void **state)
{
    (void)state;
    static const double values[] = {0, 1, 0}, depths[] = {0.25, 0.75, 0.25};
    struct rg_plane plane;
    struct rg_place place;
    const struct rg_primitive flat = half_square();
    assert_true(rg_plane_of(scene, &flat, scene->grid, &plane));
    // 1 / 20 a pixel, so that a step of the grid is 1 / 5120.
    rg_plane_at(&plane, 15, 12, 0, &place);
    assert_span(rg_plane_value(&place, values, true), 0.25 - 1 / 5120.0, 0.25 + 1 / 5120.0);
    rg_plane_at(&plane, 10, 12, 0, &place);
    assert_span(rg_plane_value(&place, values, true), 0, 1 / 5120.0);
    rg_plane_at(&plane, 15, 12, 0.5, &place);
    assert_span(rg_plane_value(&place, values, true), 0.225 - 1 / 5120.0, 0.275 + 1 / 5120.0);
    rg_plane_at(&plane, 20, 12, 0, &place);
    assert_span(rg_plane_affine(&place, depths), 0.5 - 0.5 / 5120, 0.5 + 0.5 / 5120);
    assert_span(rg_plane_step(&plane, values, 15, 12, false), 0.05 - 0.1 / 256, 0.05 + 0.1 / 256);
    assert_span(rg_plane_step(&plane, values, 15, 12, true), -0.1 / 256, 0.1 / 256);
    // From w 1 to w 3 the middle of the screen has a quarter of the far value.
    const struct rg_primitive deep =
        triangle(corner(10, 10, 1, 0), corner(30, 10, 3, 1), corner(10, 30, 1, 0));
    assert_true(rg_plane_of(scene, &deep, 1e-9, &plane));
    rg_plane_at(&plane, 20, 10, 0, &place);
    assert_span(rg_plane_value(&place, values, true), 0.25, 0.25);
    const struct rg_primitive none =
        triangle(corner(10, 10, 1, 0), corner(20, 20, 1, 1), corner(30, 30, 1, 0));
    assert_false(rg_plane_of(scene, &none, scene->grid, &plane));
}

// Depth rises by 1/40 a pixel in x: slope factor 1, and 2 units of 2^-24 for depths below 1.
static void an_offset_is_slope_and_units(void **state)
{
    (void)state;
    static const struct rg_fixed_state offset = {
        .depth = RG_FIXED_D32F, .offset_slope_16 = 16, .offset_units = 2};
    static const struct rg_fixed_state slope = {.depth = RG_FIXED_D32F, .offset_slope_16 = 16};
    struct rg_primitive sloped = half_square();
    sloped.corners[1].place[2] = 0.75;
    sloped.corners[0].place[2] = sloped.corners[2].place[2] = 0.25;
    scene->state = &offset;
    const struct rg_span exact = rg_plane_offset(scene, &sloped, 0);
    const struct rg_span snapped = rg_plane_offset(scene, &sloped, scene->grid);
    scene->state = &slope;
    assert_near(exact.low - rg_plane_offset(scene, &sloped, 0).low, ldexp(2, -24), 1e-12);
    for (int i = 0; i < 3; i++) // the greatest depth is now 0.1875
        sloped.corners[i].place[2] /= 4;
    const struct rg_span near = rg_plane_offset(scene, &sloped, 0);
    scene->state = &offset;
    assert_near(rg_plane_offset(scene, &sloped, 0).high - near.high, ldexp(2, -26), 1e-12);
    scene->state = &plain;
    assert_span(exact, 1 / 40.0, 1 / 40.0);
    assert_true(snapped.low < exact.low && snapped.high > exact.high);
    assert_below(snapped.high - snapped.low, 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_near_an_edge_may_be_covered),
        cmocka_unit_test(what_lies_outside_is_clipped),
        cmocka_unit_test(values_are_those_of_the_plane),
        cmocka_unit_test(an_offset_is_slope_and_units),
    };
    return cmocka_run_group_tests_name("bounds of places", tests, begin, end);
}
