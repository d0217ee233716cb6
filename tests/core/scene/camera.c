// Cameras and placements against closed-form cases in double precision.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/scene/camera.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static void apply(const float matrix[16], const double point[3], double result[4])
{
    for (int row = 0; row < 4; row++) {
        result[row] = (double)matrix[4 * row + 3];
        for (int c = 0; c < 3; c++)
            result[row] += (double)matrix[4 * row + c] * point[c];
    }
}

static void expect_near(const double *actual, const double *expected, int count, double within)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(actual[i] - expected[i]) <= within))
            fail_msg("value %d is %.9g, expected %.9g", i, actual[i], expected[i]);
}

// A camera on the z axis with a right angle of view: at distance d the picture is 2 d high.
static const struct rg_camera plain = {{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 90, 2, 50};

static void test_corners_of_the_view(void **state)
{
    (void)state;
    const double aspect = 1.5;
    float matrix[16];
    assert_true(rg_camera_matrix(&plain, (float)aspect, matrix));
    // x goes right and y down: the upper right corner of the picture is (1, -1).
    static const double distances[] = {2, 5, 50};
    for (int i = 0; i < 3; i++) {
        const double d = distances[i], point[3] = {aspect * d, d, 10 - d};
        // depth = far / (far - near) * (1 - near / d)
        const double expected[4] = {d, -d, 50.0 / 48 * (d - 2), d};
        double clip[4];
        apply(matrix, point, clip);
        expect_near(clip, expected, 4, 1e-5);
    }
}

// In double precision, straight from the definition: the camera's three axes, then the division by
// distance.
static void test_any_camera(void **state)
{
    (void)state;
    const struct rg_camera camera = {{3, -2, 7}, {-1, 4, 1.5f}, {0.3f, 2, -0.4f}, 37, 0.25f, 400};
    const double aspect = 16.0 / 9;
    float matrix[16], view[16];
    assert_true(rg_camera_matrix(&camera, (float)aspect, matrix));
    assert_true(rg_camera_view(&camera, view));
    double ahead[3], right[3], up[3], length = 0, across = 0;
    for (int c = 0; c < 3; c++)
        ahead[c] = (double)camera.target[c] - (double)camera.position[c];
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        length += ahead[c] * ahead[c];
        right[c] = ahead[d] * (double)camera.up[e] - ahead[e] * (double)camera.up[d];
        across += right[c] * right[c];
    }
    for (int c = 0; c < 3; c++) {
        ahead[c] /= sqrt(length);
        right[c] /= sqrt(across);
    }
    for (int c = 0; c < 3; c++)
        up[c] = right[(c + 1) % 3] * ahead[(c + 2) % 3] - right[(c + 2) % 3] * ahead[(c + 1) % 3];
    const double scale = 1 / tan(37 * acos(-1) / 360);
    for (int i = 0; i < 27; i++) {
        const double point[3] = {i % 3 * 5 - 7, i / 3 % 3 * 4 - 3, i / 9 * 6 - 8};
        double x = 0, y = 0, z = 0, clip[4], seen[4];
        for (int c = 0; c < 3; c++) {
            const double from = point[c] - (double)camera.position[c];
            x += from * right[c];
            y += from * up[c];
            z += from * ahead[c];
        }
        const double expected[4] = {x * scale / aspect, -y * scale, (z - 0.25) * 400 / 399.75, z};
        const double own[4] = {x, y, -z, 1};
        apply(matrix, point, clip);
        apply(view, point, seen);
        expect_near(clip, expected, 4, 2e-5);
        expect_near(seen, own, 4, 1e-5);
    }
}

// The C library's tangents of floats are not the nearest ones to these, in one version or another.
static void test_angles_rounded_once(void **state)
{
    (void)state;
    static const struct {
        int angle_deg;
        float scale;
    } cases[] = {{45, 0x1.3504f2p+1f}, {58, 0x1.cdd612p+0f},  {60, 0x1.bb67bp+0f},
                 {70, 0x1.6d9b18p+0f}, {72, 0x1.605a9p+0f},   {82, 0x1.267e8cp+0f},
                 {96, 0x1.cd01c2p-1f}, {118, 0x1.33a402p-1f}, {141, 0x1.6a9e0ap-2f}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_camera camera = plain;
        float matrix[16];
        camera.angle_deg = (float)cases[i].angle_deg;
        assert_true(rg_camera_matrix(&camera, 1, matrix));
        assert_equals((double)-matrix[5], (double)cases[i].scale);
    }
}

static void expect_blind(struct rg_camera camera, float aspect, const char *why)
{
    float matrix[16];
    assert_false(rg_camera_matrix(&camera, aspect, matrix));
    if (!strstr(rg_last_error(), why))
        fail_msg("the line was: %s", rg_last_error());
}

static void test_cameras_that_see_nothing(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    struct rg_camera c = plain;
    expect_blind(c, 0, "0 times as wide");
    expect_blind(c, NAN, "times as wide");
    c.angle_deg = 180;
    expect_blind(c, 1, "180 degrees");
    c.angle_deg = 0;
    expect_blind(c, 1, "0 degrees");
    c = plain;
    c.near_plane = 0;
    expect_blind(c, 1, "planes at 0 and 50");
    c.near_plane = 50;
    expect_blind(c, 1, "planes at 50 and 50");
    c.far_plane = INFINITY;
    expect_blind(c, 1, "planes");
    c = plain;
    c.target[2] = 10;
    expect_blind(c, 1, "another point");
    c.target[2] = NAN;
    expect_blind(c, 1, "another point");
    c = plain;
    c.up[1] = 0;
    expect_blind(c, 1, "not along its up");
    c.up[2] = -3;
    expect_blind(c, 1, "not along its up");
    rg_log_listen(NULL, NULL);
}

static void test_placements(void **state)
{
    (void)state;
    // A box of size 2 by 4 by 8, about (2, 3, 5).
    static const float low[3] = {1, 1, 1}, high[3] = {3, 5, 9};
    struct rg_placement placement = {4, {0, 0, 0}, {10, 20, 30}};
    static const double corner[3] = {3, 5, 9};
    float matrix[16];
    double result[4];
    rg_place(low, high, &placement, matrix);
    apply(matrix, corner, result);
    expect_near(result, (const double[4]){10.5, 21, 32, 1}, 4, 1e-5);
    // The half diagonal is (0.5, 1, 2). About x, y goes to z; about y, z to x; about z, x to y.
    static const struct {
        float turn[3];
        double expected[4];
    } cases[] = {
        {{90, 0, 0}, {10.5, 18, 31, 1}},   {{0, 90, 0}, {12, 21, 29.5, 1}},
        {{0, 0, 90}, {9, 20.5, 32, 1}},    {{90, 90, 0}, {11, 18, 29.5, 1}},
        {{90, 0, 90}, {12, 20.5, 31, 1}},  {{0, 90, 90}, {9, 22, 29.5, 1}},
        {{90, 90, 90}, {12, 21, 29.5, 1}}, {{360, -360, 720}, {10.5, 21, 32, 1}},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        memcpy(placement.turn_deg, cases[i].turn, sizeof(cases[i].turn));
        rg_place(low, high, &placement, matrix);
        apply(matrix, corner, result);
        expect_near(result, cases[i].expected, 4, 2e-5);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corners_of_the_view), cmocka_unit_test(test_any_camera),
        cmocka_unit_test(test_angles_rounded_once), cmocka_unit_test(test_cameras_that_see_nothing),
        cmocka_unit_test(test_placements),
    };
    return cmocka_run_group_tests_name("cameras", tests, NULL, NULL);
}
