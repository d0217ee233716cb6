// Shadows of streaks' lights: shadows DEVICE. Against rays through boxes, in double precision.
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/scenery/lights/rig.h"
#include "tests/tools/expect.h"

// Whether a light reaches a point; -1 if that differs within `margin` of it.
static int reached_about(const struct rg_light *light, struct vec at, double bias, double margin)
{
    int lit = 0, tried = 0;
    for (int x = -1; x <= 1; x++)
        for (int y = -1; y <= 1; y++)
            for (int z = -1; z <= 1; z++) {
                const struct vec p = {at.x + x * margin, at.y + y * margin, at.z + z * margin};
                const struct vec off = light->kind == SCENERY_SUN
                                           ? along((struct vec){0, 0, 0}, -100, rig_way_of(light))
                                           : minus(rig_place_of(light), p);
                const double all = length(off), near = (double)light->near_m;
                lit +=
                    !rig_is_blocked(along(p, bias / all, off), along(p, (all - near) / all, off));
                tried++;
            }
    return lit == tried ? 1 : lit == 0 ? 0 : -1;
}

struct seen {
    int lit, shadowed, wrong, soft_wrong, unsure;
};

static void check_point(const struct rg_light *light, const scenery_light *l, struct vec at,
                        const test_streaks_lit *lit, struct seen *seen)
{
    const double away = light->kind == SCENERY_SUN ? 1 : length(minus(at, rig_place_of(light)));
    // A texel's half diagonal, doubled for reads between four texels, and some more.
    const int due = reached_about(light, at, (double)l->shadow_bias_m,
                                  2 * (double)l->shadow_texel * away + 0.01);
    seen->lit += due == 1;
    seen->shadowed += due == 0;
    seen->unsure += due < 0;
    seen->wrong += due >= 0 && lit->unshadowed != (float)due;
    seen->soft_wrong += due >= 0 && lit->soft != (float)due;
}

static void shadows_fall_where_rays_are_blocked(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = rig_make_points();
    test_streaks_lit *lit = rig_light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    for (int k = 0; k < UNSHADOWED; k++) {
        struct seen seen = {0};
        int inside = 0;
        for (int i = 0; i < POINTS; i++) {
            if (!rig_is_in_cone(&rig_lights[k], rig_point_at(points, i)))
                continue;
            inside++;
            check_point(&rig_lights[k], &rig.lights[k], rig_point_at(points, i),
                        &lit[k * POINTS + i], &seen);
        }
        print_message("light %d: %d lit, %d shadowed, %d on an edge, %d and %d wrong\n", k,
                      seen.lit, seen.shadowed, seen.unsure, seen.wrong, seen.soft_wrong);
        assert_above(seen.lit, inside / 5);
        assert_above(seen.shadowed, inside / 50);
        assert_below(seen.unsure, inside / 2);
        assert_int_equal(seen.wrong, 0);
        assert_int_equal(seen.soft_wrong, 0);
    }
    free(lit);
    free(points);
    rig_close(&rig);
}

// A floor is not shaded by itself, only by things on it.
static void floors_do_not_shade_themselves(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = rig_make_points();
    for (int i = 0; i < POINTS; i++)
        points[3 * i + 1] = 0;
    test_streaks_lit *lit = rig_light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    for (int k = 0; k < UNSHADOWED; k++) {
        int bright = 0, dark = 0;
        for (int i = 0; i < POINTS; i++) {
            struct vec at = rig_point_at(points, i);
            const double away = rig_lights[k].kind == SCENERY_SUN
                                    ? 1
                                    : length(minus(at, rig_place_of(&rig_lights[k])));
            const double texel = (double)rig.lights[k].shadow_texel * away;
            at.y = 4 * texel + 0.05; // the oracle's margin stays off the floor
            const int due = reached_about(&rig_lights[k], at, 0, 3 * texel + 0.02);
            if (due < 0 || !rig_is_in_cone(&rig_lights[k], at))
                continue;
            bright += due;
            dark += !due;
            assert_equals(lit[k * POINTS + i].surface, (float)due);
        }
        assert_above(bright, POINTS / 20);
        assert_above(dark, POINTS / 500);
    }
    free(lit);
    free(points);
    rig_close(&rig);
}

// The bias is in metres along the ray: a point less deep in the floor is lit, and a deeper one is
// not.
static void the_bias_is_metres_along_the_ray(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = rig_make_points();
    int checked[LIGHTS] = {0};
    for (int k = 3; k <= 4; k++) { // straight down, so that the floor has one depth
        const struct rg_light *light = &rig_lights[k];
        for (int i = 0; i < POINTS; i++) {
            const struct vec at = {(double)points[3 * i], 0, (double)points[3 * i + 2]};
            const struct vec off = minus(at, rig_place_of(light));
            const struct vec way = light->kind == SCENERY_SUN
                                       ? rig_way_of(light)
                                       : along((struct vec){0, 0, 0}, 1 / length(off), off);
            const double deep = (double)rig.lights[k].shadow_bias_m * (i % 2 ? 0.9 : 1.1);
            const struct vec in = along(at, deep, way);
            points[3 * i] = (float)in.x;
            points[3 * i + 1] = (float)in.y;
            points[3 * i + 2] = (float)in.z;
        }
        test_streaks_lit *lit = rig_light_points(&rig, &rig.lights[k], 1, points, POINTS);
        for (int i = 0; i < POINTS; i++) {
            struct vec at = rig_point_at(points, i);
            at.y = 0.3;
            if (reached_about(light, at, 0, 0.25) != 1 || !rig_is_in_cone(light, at))
                continue;
            assert_equals(lit[i].unshadowed, (i % 2 ? 1.0f : 0.0f));
            checked[k]++;
        }
        free(lit);
    }
    assert_above(checked[3], POINTS / 2);
    assert_above(checked[4], POINTS / 100);
    free(points);
    rig_close(&rig);
}

// Soft shadows change from light to dark over one texel, in any direction: an eighth of a texel
// changes them by an eighth.
static void soft_shadows_do_not_jump(void **state)
{
    enum { DOWN = 3, ROWS = 12, STEPS = POINTS / ROWS };
    struct rig rig = rig_open(*state);
    const double step = (double)rig.lights[DOWN].shadow_texel / 8;
    float *points = malloc(POINTS * 3 * sizeof(*points));
    for (int i = 0; i < POINTS; i++) { // rows about an edge of a box, across and along
        const double t = (i % STEPS - STEPS / 2) * step, row = i / STEPS * 0.013;
        points[3 * i] = (float)(i / STEPS % 2 ? 1 + t : -0.7 + row);
        points[3 * i + 1] = 1;
        points[3 * i + 2] = (float)(i / STEPS % 2 ? 0.3 + row : 2 + t);
    }
    test_streaks_lit *lit = rig_light_points(&rig, &rig.lights[DOWN], 1, points, POINTS);
    int between = 0;
    for (int i = 1; i < POINTS; i++) {
        between += lit[i].soft > 0 && lit[i].soft < 1;
        if (i % STEPS)
            assert_below(fabsf(lit[i].soft - lit[i - 1].soft), 0.126f);
    }
    assert_at_least(between, 5 * ROWS);
    free(lit);
    free(points);
    rig_close(&rig);
}

static void nothing_shades_where_no_map_is(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = rig_make_points();
    scenery_light lights[LIGHTS];
    memcpy(lights, rig.lights, sizeof(lights));
    for (int k = 0; k < LIGHTS; k++)
        lights[k].shadow_layer = -1;
    test_streaks_lit *lit = rig_light_points(&rig, lights, LIGHTS, points, POINTS),
                     *with = rig_light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    for (int i = 0; i < LIGHTS * POINTS; i++)
        assert_true(lit[i].unshadowed == 1 && lit[i].soft == 1 && lit[i].surface == 1);
    int beside = 0;
    for (int i = 0; i < POINTS; i++) { // a frustum reaches farthest at its corners
        const struct rg_light *spot = &rig_lights[1];
        const struct vec off = minus(rig_point_at(points, i), rig_place_of(spot));
        const double corner = atan(1.42 * 1.01 * tan((double)spot->outer_deg * degree));
        if (dot(off, rig_way_of(spot)) > length(off) * cos(corner))
            continue;
        beside++;
        assert_equals(with[POINTS + i].unshadowed, 1);
        assert_equals(with[POINTS + i].soft, 1);
    }
    assert_above(beside, POINTS / 10);
    free(lit);
    free(with);
    free(points);
    rig_close(&rig);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadows_fall_where_rays_are_blocked),
        cmocka_unit_test(floors_do_not_shade_themselves),
        cmocka_unit_test(the_bias_is_metres_along_the_ray),
        cmocka_unit_test(soft_shadows_do_not_jump),
        cmocka_unit_test(nothing_shades_where_no_map_is),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
