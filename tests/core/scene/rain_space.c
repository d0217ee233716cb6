// The rain space: its frame and matrices, a camera's view of it, and drops that stay in place when
// the local space moves.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "core/scene/rain_space.h"
#include "tests/core/techniques/rigs/packets.h"
#include "tests/oracle/streaks/packets.h"
#include "tests/tools/expect.h"

static void expect_near(const double *actual, const double *expected, int count, double within)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(actual[i] - expected[i]) <= within))
            fail_msg("value %d is %.9g, expected %.9g", i, actual[i], expected[i]);
}

static void apply(const float matrix[16], const double point[3], double result[4])
{
    for (int row = 0; row < 4; row++) {
        result[row] = (double)matrix[4 * row + 3];
        for (int c = 0; c < 3; c++)
            result[row] += (double)matrix[4 * row + c] * point[c];
    }
}

static void test_straight_down(void **state)
{
    (void)state;
    const struct rg_rain_space_settings settings = {
        .ground_m = {1, 2, 3}, .fall = {0, -7, 0}, .width_m = 400, .depth_m = 300, .height_m = 230};
    struct rg_rain_space space;
    assert_true(rg_rain_space_make(&settings, &space));
    const double top[3] = {1, 232, 3}, sizes[3] = {200, 150, 230};
    expect_near(space.origin_m, top, 3, 1e-12);
    expect_near(&space.half_x_m, sizes, 3, 0);
    const double world[3] = {11, 232 - 50, 23}, expected[3] = {10, 20, 50};
    double rain[3];
    rg_rain_point(&space, world, rain);
    expect_near(rain, expected, 3, 1e-12);
}

// For any direction of fall the frame is the oracle's, in both directions, for points and by
// matrices.
static void test_any_fall(void **state)
{
    (void)state;
    uint64_t random = 11;
    for (int i = 0; i < 200; i++) {
        struct rg_rain_space_settings settings = {
            .width_m = 1, .depth_m = 2, .height_m = oracle_uniform(&random, 1, 100)};
        double length = 0, origin[3], world[3], rain[3], there[4], back[4];
        for (int k = 0; k < 3; k++) {
            settings.ground_m[k] = oracle_uniform(&random, -50, 50);
            settings.fall[k] = oracle_uniform(&random, -1, 1);
            length += settings.fall[k] * settings.fall[k];
            rain[k] = oracle_uniform(&random, -100, 100);
        }
        if (fabs(settings.fall[0]) > 0.98 * sqrt(length))
            continue; // along x the frame differs; see below
        struct rg_rain_space space;
        assert_true(rg_rain_space_make(&settings, &space));
        for (int k = 0; k < 3; k++)
            origin[k] = settings.ground_m[k] - settings.height_m * settings.fall[k] / sqrt(length);
        const struct oracle_frame frame = oracle_frame_at(origin, settings.fall);
        expect_near(space.x, frame.axes[0], 3, 1e-12);
        expect_near(space.y, frame.axes[1], 3, 1e-12);
        expect_near(space.s, frame.axes[2], 3, 1e-12);
        oracle_to_world(&frame, rain, world);
        float to_rain[16], to_world[16];
        rg_rain_matrices(&space, to_rain, to_world);
        rg_rain_world_point(&space, rain, there);
        expect_near(there, world, 3, 1e-9);
        rg_rain_point(&space, world, back);
        expect_near(back, rain, 3, 1e-9);
        apply(to_world, rain, there);
        apply(to_rain, world, back);
        expect_near(there, world, 3, 1e-4);
        expect_near(back, rain, 3, 1e-4);
        assert_equals(there[3], 1);
        assert_equals(back[3], 1);
        rg_rain_to_clip(&space, to_rain, to_world); // there and back is the identity
        for (int k = 0; k < 16; k++)
            assert_below(fabs((double)to_world[k] - (k % 5 == 0)), 1e-4);
    }
}

// Rain that falls along x still has a frame: unit axes at right angles, with x cross y = s.
static void test_fall_along_x(void **state)
{
    (void)state;
    for (int sign = -1; sign < 2; sign += 2) {
        const struct rg_rain_space_settings settings = {
            .fall = {sign, 0, 0}, .width_m = 1, .depth_m = 1, .height_m = 1};
        struct rg_rain_space space;
        assert_true(rg_rain_space_make(&settings, &space));
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            const double s = space.x[j] * space.y[k] - space.x[k] * space.y[j];
            assert_below(fabs(s - settings.fall[i]), 1e-12);
        }
    }
}

static void test_slant(void **state)
{
    (void)state;
    double fall[3];
    rg_rain_fall(0, 77, fall);
    expect_near(fall, (const double[]){0, -1, 0}, 3, 1e-12);
    rg_rain_fall(30, 0, fall);
    expect_near(fall, (const double[]){0.5, -sqrt(0.75), 0}, 3, 1e-12);
    rg_rain_fall(30, 90, fall);
    expect_near(fall, (const double[]){0, -sqrt(0.75), 0.5}, 3, 1e-12);
}

// The frustum's corners project into the picture's corners, the near ones to depth 0. The far ones
// lie beyond all of the rain space.
static void test_view_corners(void **state)
{
    (void)state;
    const struct rg_rain_space_settings settings = {.ground_m = {5, -3, 8},
                                                    .fall = {0.4, -1, 0.2},
                                                    .width_m = 100,
                                                    .depth_m = 60,
                                                    .height_m = 80};
    struct rg_rain_space space;
    assert_true(rg_rain_space_make(&settings, &space));
    const struct rg_camera camera = {{3, -2, 7}, {-1, 4, 1.5f}, {0.3f, 2, -0.4f}, 37, 0.25f, 20};
    double corners[8][3], clip[4];
    float to_clip[16], rain_to_clip[16];
    assert_true(rg_rain_view_corners(&space, &camera, 1.6, corners));
    assert_true(rg_camera_matrix(&camera, 1.6f, to_clip));
    rg_rain_to_clip(&space, to_clip, rain_to_clip);
    int seen = 0;
    double far_m = 0;
    for (int i = 0; i < 8; i++) {
        apply(rain_to_clip, corners[i], clip);
        assert_below(fabs(fabs(clip[0] / clip[3]) - 1), 1e-4);
        assert_below(fabs(fabs(clip[1] / clip[3]) - 1), 1e-4);
        seen |= 1 << ((clip[0] > 0) + 2 * (clip[1] > 0) + 4 * (i > 3));
        if (i < 4)
            assert_below(fabs(clip[2]), 1e-4);
        else
            far_m = clip[3];
    }
    for (int i = 0; i < 8; i++) {
        const double corner[3] = {i & 1 ? 50 : -50, i & 2 ? 30 : -30, i & 4 ? 80 : 0};
        apply(rain_to_clip, corner, clip);
        assert_below(clip[3], far_m);
    }
    assert_int_equal(seen, 255);
}

// --- the local space ---

// A drop's place in the world: s in the rain frame.
static double place(double start, double time_s, double top_m, double height_m)
{
    const double turns = start + rg_rain_run(8.16, time_s, top_m, height_m);
    return top_m + height_m * (turns - floor(turns));
}

// The local space moves up and down with the observer, and drops do not. A drop that leaves it
// returns a whole local space away.
static void test_drops_stay_where_they_are(void **state)
{
    (void)state;
    uint64_t random = 12;
    int stayed = 0, came_in_again = 0;
    for (int i = 0; i < 20000; i++) {
        const double height = oracle_uniform(&random, 1, 230);
        const double time = oracle_uniform(&random, 0, 5000), start = oracle_uniform(&random, 0, 1);
        const double top = oracle_uniform(&random, -100, 200);
        const double other_top = top + oracle_uniform(&random, -1.5, 1.5) * height;
        const double s = place(start, time, top, height);
        const double other = place(start, time, other_top, height);
        assert_at_least(s, top);
        assert_at_most(s, top + height);
        const double whole = (other - s) / height;
        assert_below(fabs(whole - rint(whole)), 1e-9);
        const bool inside = s > other_top + 1e-6 && s < other_top + height - 1e-6;
        if (inside)
            assert_below(fabs(other - s), 1e-6);
        stayed += inside;
        came_in_again += !inside;
        // The drop falls at its speed.
        const double later = place(start, time + 0.25, top, height);
        const double fallen = (later - s - 8.16 * 0.25) / height;
        assert_below(fabs(fallen - rint(fallen)), 1e-9);
    }
    assert_above(stayed, 1000);
    assert_above(came_in_again, 1000);
}

// Against the thesis, which adds to the run position frame by frame. It adds time / (height /
// speed) and, in clip coordinates, (h'_o - h_o) / h_l; h_o is the observer's distance from the top.
static void test_run_is_the_thesis_sum(void **state)
{
    (void)state;
    uint64_t random = 13;
    const double local = 20, total = 230;
    double eye = 100, time = 0;
    double run = rg_rain_run(8.16, time, rg_rain_local_top(eye, local), local);
    for (int frame = 0; frame < 2000; frame++) {
        const double dt = oracle_uniform(&random, 0, 0.1);
        const double next = oracle_uniform(&random, 0, total);
        const double h_l = 2 * local / total, before = 2 * eye / total, after = 2 * next / total;
        run += dt / (local / 8.16) + (before - after) / h_l;
        run -= floor(run);
        time += dt;
        eye = next;
        const double ours = rg_rain_run(8.16, time, rg_rain_local_top(eye, local), local);
        assert_at_least(ours, 0);
        assert_below(ours, 1);
        const double apart = ours - run;
        assert_below(fabs(apart - rint(apart)), 1e-9);
        expect_near((const double[]){rg_rain_local_top(eye, local)},
                    (const double[]){eye - local / 2}, 1, 1e-12);
    }
}

static void test_wrong_spaces(void **state)
{
    (void)state;
    const struct rg_rain_space_settings good = {
        .fall = {0, -1, 0}, .width_m = 1, .depth_m = 1, .height_m = 1};
    struct rg_rain_space_settings wrong[7];
    for (int i = 0; i < 7; i++)
        wrong[i] = good;
    wrong[0].fall[1] = 0;
    wrong[1].fall[2] = NAN;
    wrong[2].width_m = 0;
    wrong[3].depth_m = -3;
    wrong[4].height_m = INFINITY;
    wrong[5].ground_m[0] = NAN;
    wrong[6].fall[1] = 1e300;
    for (int i = 0; i < 7; i++) {
        struct rg_rain_space space;
        rig_listen();
        assert_false(rg_rain_space_make(&wrong[i], &space));
        assert_int_equal(rig_errors(), 1);
    }
    struct rg_rain_space space;
    assert_true(rg_rain_space_make(&good, &space));
    const struct rg_camera blind = {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}, 50, 1, 2};
    double corners[8][3];
    rig_listen();
    assert_false(rg_rain_view_corners(&space, &blind, 1, corners));
    assert_int_equal(rig_errors(), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_straight_down),
        cmocka_unit_test(test_any_fall),
        cmocka_unit_test(test_fall_along_x),
        cmocka_unit_test(test_slant),
        cmocka_unit_test(test_view_corners),
        cmocka_unit_test(test_drops_stay_where_they_are),
        cmocka_unit_test(test_run_is_the_thesis_sum),
        cmocka_unit_test(test_wrong_spaces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
