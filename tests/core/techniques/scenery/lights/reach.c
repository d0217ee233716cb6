// The reach of streaks' lights: reach DEVICE. Against closed forms in double precision, alone and
// together, and in any frame.
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/scenery/lights/rig.h"
#include "tests/tools/expect.h"

static double share_due(const struct rg_light *light, struct vec at)
{
    if (light->kind == SCENERY_SUN)
        return 1;
    const struct vec off = minus(at, rig_place_of(light));
    const double distance = length(off), fallen = 1 / (distance * distance);
    if (light->kind == SCENERY_POINT)
        return fallen;
    const double cosine = dot(off, rig_way_of(light)) / distance,
                 inner = cos((double)light->inner_deg * degree),
                 outer = cos((double)light->outer_deg * degree);
    const double t = fmin(fmax((cosine - outer) / (inner - outer), 0), 1);
    return fallen * (3 * t * t - 2 * t * t * t);
}

static void lights_reach_as_the_closed_forms_say(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = rig_make_points();
    test_streaks_lit *lit = rig_light_points(&rig, rig.lights, LIGHTS, points, POINTS);
    int dark = 0, bright = 0;
    for (int k = 0; k < LIGHTS; k++) {
        for (int i = 0; i < POINTS; i++) {
            const test_streaks_lit *l = &lit[k * POINTS + i];
            const struct vec at = rig_point_at(points, i),
                             off = minus(rig_place_of(&rig_lights[k]), at),
                             to = rig_lights[k].kind == SCENERY_SUN
                                      ? along((struct vec){0, 0, 0}, -1, rig_way_of(&rig_lights[k]))
                                      : along((struct vec){0, 0, 0}, 1 / length(off), off);
            const double share = share_due(&rig_lights[k], at);
            // A cone's edge is as steep as its width allows, and its cosine rounds to 1e-7.
            assert_at_most(fabs((double)l->share - share), 2e-6 * share + 1e-6 / dot(off, off));
            assert_below(length(minus((struct vec){(double)l->to_light.x, (double)l->to_light.y,
                                                   (double)l->to_light.z},
                                      to)),
                         1e-6);
            if (rig_lights[k].kind == SCENERY_SPOT) {
                dark += l->share == 0;
                bright += l->share > 0;
            }
        }
    }
    assert_above(dark, POINTS / 10);
    assert_above(bright, POINTS / 10);
    free(lit);
    free(points);
    rig_close(&rig);
}

// All light on the axis and within the inner cone; less and less from there; none from the outer
// cone on. It is never stronger than at the nearest distance, even inside the light.
static void cones_and_near_points_have_their_bounds(void **state)
{
    enum { STEPS = 89 };
    struct rig rig = rig_open(*state);
    float points[3 * (STEPS + 3)];
    const struct rg_light *light = &rig_lights[4]; // straight down
    for (int i = 0; i <= STEPS; i++) {
        points[3 * i] = light->position_m[0] + (float)(2 * sin(i * degree));
        points[3 * i + 1] = light->position_m[1] - (float)(2 * cos(i * degree));
        points[3 * i + 2] = light->position_m[2];
    }
    memcpy(points + 3 * (STEPS + 1), light->position_m, sizeof(light->position_m));
    memcpy(points + 3 * (STEPS + 2), light->position_m, sizeof(light->position_m));
    points[3 * (STEPS + 2) + 1] -= 0.05f;
    test_streaks_lit *lit = rig_light_points(&rig, &rig.lights[4], 1, points, STEPS + 3);
    assert_float_equal(lit[0].share, 0.25f, 1e-6f);
    for (int i = 1; i <= STEPS; i++) {
        if (i > light->outer_deg)
            assert_equals(lit[i].share, 0);
        else if (i < light->outer_deg)
            assert_true(lit[i].share > 0 && lit[i].share < lit[i - 1].share);
    }
    assert_at_least(lit[STEPS + 1].share, 0);
    assert_at_most(lit[STEPS + 1].share, 100.0001f);
    assert_float_equal(lit[STEPS + 2].share, 100, 1e-3f);
    free(lit);
    rig_close(&rig);
}

// --- sums, frames ---

// Lights do not affect each other: alone, or in any order, they give what they give together.
static void lights_add_up(void **state)
{
    struct rig rig = rig_open(*state);
    float *points = rig_make_points();
    scenery_light turned[LIGHTS];
    for (int k = 0; k < LIGHTS; k++)
        turned[k] = rig.lights[LIGHTS - 1 - k];
    test_streaks_lit *all = rig_light_points(&rig, rig.lights, LIGHTS, points, POINTS),
                     *back = rig_light_points(&rig, turned, LIGHTS, points, POINTS);
    for (int k = 0; k < LIGHTS; k++) {
        test_streaks_lit *one = rig_light_points(&rig, &rig.lights[k], 1, points, POINTS);
        assert_memory_equal(one, all + k * POINTS, POINTS * sizeof(*one));
        assert_memory_equal(one, back + (LIGHTS - 1 - k) * POINTS, POINTS * sizeof(*one));
        free(one);
    }
    free(all);
    free(back);
    free(points);
    rig_close(&rig);
}

// In a rotated and moved frame the same light reaches the same points, except for rounding.
static void frames_do_not_matter(void **state)
{
    static const float matrix[16] = {0.8f,  0,     -0.6f, 10, 0.36f, 0.8f, 0.48f, -20,
                                     0.48f, -0.6f, 0.64f, 5,  0,     0,    0,     1};
    struct rig rig = rig_open(*state);
    float *points = rig_make_points(), *moved = malloc(POINTS * 3 * sizeof(float));
    scenery_light lights[LIGHTS];
    for (int k = 0; k < LIGHTS; k++)
        lights[k] = scenery_light_moved(&rig.lights[k], matrix);
    for (int i = 0; i < POINTS; i++)
        for (int c = 0; c < 3; c++)
            moved[3 * i + c] = matrix[4 * c] * points[3 * i] +
                               matrix[4 * c + 1] * points[3 * i + 1] +
                               matrix[4 * c + 2] * points[3 * i + 2] + matrix[4 * c + 3];
    test_streaks_lit *here = rig_light_points(&rig, rig.lights, LIGHTS, points, POINTS),
                     *there = rig_light_points(&rig, lights, LIGHTS, moved, POINTS);
    int unequal = 0;
    for (int k = 0; k < LIGHTS; k++)
        for (int i = 0; i < POINTS; i++) {
            const test_streaks_lit *a = &here[k * POINTS + i], *b = &there[k * POINTS + i];
            const double d = length(minus(rig_point_at(points, i), rig_place_of(&rig_lights[k])));
            assert_at_most(fabsf(a->share - b->share), 2e-5f * a->share + (float)(1e-5 / d / d));
            unequal += a->unshadowed != b->unshadowed;
        }
    assert_below(unequal, LIGHTS * POINTS / 2000); // on the edges of texels
    free(here);
    free(there);
    free(points);
    free(moved);
    rig_close(&rig);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_reach_as_the_closed_forms_say),
        cmocka_unit_test(cones_and_near_points_have_their_bounds),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(frames_do_not_matter),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
