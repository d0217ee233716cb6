// The lit pane against a ray tracer in double precision, which shares nothing with kernels/.
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/drops/view/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

#define RAINY                                                                                      \
    "columns=96 rows=64 drops_s=150 max_drops=300 environment=sky environment_px=64 "              \
    "aperture_mm=0 "

static struct rg_device *device;

// --- what is compared ---

// Halves are rounded down, by 1 part in 2^10. Floats round by parts in 10^7, which become parts in
// 10^5 near the angle of total reflection. If a height is as near to the water's edge as floats
// resolve, the two may disagree whether water bends light there.
static const double TOLERANCE = 1.0 / 1000, MARGIN_MM = 1e-5;

static double worst; // over all runs

static bool is_near(double a, double b)
{
    const double off = fabs(a - b) / fmax(1, fabs(b));
    worst = fmax(worst, off);
    return off <= TOLERANCE;
}

static void compare(struct drops *d, const char *what)
{
    struct view_oracle oracle;
    view_oracle_of(d, &oracle);
    struct rg_picture picture = view_draw(d);
    int left_out = 0;
    for (int i = 0; i < picture.width * picture.height; i++) {
        const int x = i % picture.width, y = i / picture.width;
        double due[3], margin_mm;
        pane_oracle_pixel(&oracle.pane, x, y, due, &margin_mm);
        if (margin_mm < MARGIN_MM) {
            left_out++;
            continue;
        }
        for (int c = 0; c < 3; c++)
            if (!is_near((double)view_pixel(&picture, x, y)[c], due[c]))
                fail_msg("%s: pixel %d %d, channel %d: %g, not %g", what, x, y, c,
                         (double)view_pixel(&picture, x, y)[c], due[c]);
    }
    assert_between(left_out, 0, picture.width * picture.height / 500);
    rg_picture_destroy(&picture);
    view_oracle_free(&oracle);
}

static void compare_rain(const char *settings)
{
    char text[2048];
    snprintf(text, sizeof(text), RAINY "%s", settings);
    struct drops *d = rig_open_sized(device, text, 120, 90);
    rig_step(d, 90);
    compare(d, settings);
    rig_close(d);
}

// --- runs ---

static void rain_before_the_sky(void **state)
{
    (void)state;
    compare_rain("rays_px=1");
    compare_rain("rays_px=3 distance_mm=100 refractive_index=1.5 contact_mm=0");
    compare_rain("rays_px=2 tilt_deg=30 turn_deg=70 seed=3");
    compare_rain("rays_px=1 tilt_deg=120 turn_deg=-160 refractive_index=1.1 cell_mm=1");
}

// Bright and dark squares in three colours, which differ between rows.
static void squares(int x, int y, const void *user, float light[3])
{
    (void)user;
    for (int c = 0; c < 3; c++)
        light[c] = (x / 3 + y / (3 + c)) % 2 ? 0.9f : 0.05f * (float)(y % (7 + c));
}

static void rain_before_a_picture(void **state)
{
    (void)state;
    static const char *const settings[] = {
        "rays_px=1 background_m=0.5",
        "rays_px=2 background_m=30 background_deg=40 turn_deg=90 aperture_mm=6",
        "rays_px=1 background_m=2 background_deg=150 distance_mm=150 tilt_deg=60 turn_deg=-30",
    };
    char path[256], text[512];
    snprintf(path, sizeof(path), "%s", in_folder("squares.exr"));
    view_write(path, 150, 97, squares, NULL);
    for (int i = 0; i < 3; i++) {
        snprintf(text, sizeof(text), "%s background=%s", settings[i], path);
        compare_rain(text);
    }
    assert_int_equal(remove(path), 0);
}

// A steep wave over the whole pane: it reflects light totally, and pixels are far wider than its
// crests.
static double wave(double x_mm, double y_mm, const void *user)
{
    const double *steepness = user;
    return *steepness * (2.2 + sin(x_mm * 1.3 + y_mm * 0.4) + sin(y_mm * 0.9 - x_mm * 0.2));
}

static void waves_far_and_near(void **state)
{
    (void)state;
    static const struct {
        const char *settings;
        double steepness;
        int width, height;
    } cases[] = {{"columns=40 rows=40 rays_px=1", 1, 70, 70},
                 {"columns=200 rows=100 rays_px=1", 0.3, 30, 20},
                 {"columns=40 rows=30 rays_px=1 distance_mm=100", 2, 60, 60}};
    for (int i = 0; i < 3; i++) {
        char text[1024];
        snprintf(text, sizeof(text), RAINY "%s", cases[i].settings);
        struct drops *d = rig_open_sized(device, text, cases[i].width, cases[i].height);
        view_put_heights(d, wave, &cases[i].steepness);
        compare(d, cases[i].settings);
        rig_close(d);
    }
    print_message("the worst pixel is off by %.2g, of %.2g\n", worst, TOLERANCE);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rain_before_the_sky),
        cmocka_unit_test(rain_before_a_picture),
        cmocka_unit_test(waves_far_and_near),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, make_folder, remove_folder);
    return rg_device_close(device) ? failed : 1;
}
