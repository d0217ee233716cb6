// Slabs of far rain do not show: seams DEVICE. Dense rain has nearly its mean light in every pixel.
// That light is compared with the length of each pixel's ray between the two radii. It is also
// compared with itself as the observer passes from slab to slab.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/image/files/io.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

// Only light of the sky, a level camera, and nothing that hides.
#define SEAMS                                                                                      \
    "geometry=off drops=off splashes=off lights=0 streak_opacity=0 streak_gain=0.01 "              \
    "rain_width_m=60 rain_depth_m=60 rain_height_m=60 packets=world local_height_m=0.5 "           \
    "eye_y_m=30 target_y_m=30 view_angle_deg=20 culling_radius_m=8 far_layers=2 "                  \
    "drops_m2_s=5000 drop_radius_mm=10 exposure_s=0.02 density_map=%s "
static char map_path[64];
static const double nearest_m = 8, farthest_m = 24, slab_m = 2;

static struct streaks *open_at(double x_m, double z_m, double turned_deg)
{
    const double turned = turned_deg * acos(-1) / 180;
    char all[800];
    snprintf(all, sizeof(all), SEAMS "eye_x_m=%.9g eye_z_m=%.9g target_x_m=%.9g target_z_m=%.9g",
             map_path, x_m, z_m, x_m + 40 * sin(turned), z_m + 40 * cos(turned));
    return rain_open(all);
}

// The light that rain adds to a picture.
struct added {
    double light[RAIN_HEIGHT][RAIN_WIDTH];
};

static struct added *added_by(struct streaks *s)
{
    struct added *added = malloc(sizeof(*added));
    assert_non_null(added);
    struct rain_texels *wet = rain_read(s);
    s->settings.far_layers = 0;
    struct rain_texels *dry = rain_read(s);
    s->settings.far_layers = 2;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            added->light[y][x] = rain_texel(wet, x, y, 1) - rain_texel(dry, x, y, 1);
    free(wet);
    free(dry);
    return added;
}

// The length of a pixel's ray between two squares about the observer, along x and z.
static double way_m(int x, int y, double turned_deg)
{
    const double turned = turned_deg * acos(-1) / 180;
    const double a_px = 2 * tan(10 * acos(-1) / 180) / RAIN_HEIGHT;
    const double right = (x + 0.5 - RAIN_WIDTH / 2.0) * a_px,
                 up = (RAIN_HEIGHT / 2.0 - y - 0.5) * a_px;
    const double along_x = fabs(sin(turned) - right * cos(turned)),
                 along_z = fabs(cos(turned) + right * sin(turned));
    return (farthest_m - nearest_m) / fmax(along_x, along_z) * sqrt(1 + right * right + up * up);
}

// A column's light is proportional to its rays' length, even at 45 degrees, where slabs along x
// meet those along z.
static void expect_even(double turned_deg)
{
    struct streaks *s = open_at(0.7, -0.4, turned_deg);
    static double columns[RAIN_WIDTH];
    double all = 0;
    for (int x = 0; x < RAIN_WIDTH; x++)
        columns[x] = 0;
    enum { FRAMES = 60 };
    for (int frame = 0; frame < FRAMES; frame++) {
        rain_step(s, 20);
        struct added *added = added_by(s);
        for (int y = 0; y < RAIN_HEIGHT; y++)
            for (int x = 0; x < RAIN_WIDTH; x++) {
                const double a_metre = added->light[y][x] / way_m(x, y, turned_deg);
                columns[x] += a_metre / (FRAMES * RAIN_HEIGHT);
                all += a_metre / (FRAMES * RAIN_TEXELS);
            }
        free(added);
    }
    rain_close(s);
    assert_above(all, 0);
    double worst = 0;
    for (int x = 0; x < RAIN_WIDTH; x++)
        worst = fmax(worst, fabs(columns[x] / all - 1));
    print_message("turned by %g degrees: columns within %.3f\n", turned_deg, worst);
    assert_below(worst, 0.03);
}

static void test_no_seam_is_seen(void **state)
{
    (void)state;
    expect_even(0);
    expect_even(41);
    expect_even(135);
    expect_even(-80);
}

// How much a picture changes, as a share of its light, when the observer moves 4 mm ahead around a
// place.
static double change_about(double z_m)
{
    struct added *pictures[2];
    for (int i = 0; i < 2; i++) {
        struct streaks *s = open_at(0.7, z_m + (i ? 0.002 : -0.002), 0);
        rain_step(s, 3);
        pictures[i] = added_by(s);
        rain_close(s);
    }
    double change = 0, light = 0;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            change += fabs(pictures[1]->light[y][x] - pictures[0]->light[y][x]);
            light += pictures[0]->light[y][x];
        }
    free(pictures[0]);
    free(pictures[1]);
    return change / light;
}

// A slab behind the observer goes gradually, and the pattern of the others stays in place.
static void test_nothing_pops(void **state)
{
    (void)state;
    const double within = change_about(0.4 * slab_m), passing = change_about(0);
    print_message("within a slab %.5f, into the next one %.5f\n", within, passing);
    assert_above(within, 0);
    assert_below(passing, 1.5 * within);
}

// The map has the same density everywhere.
static void write_map(void)
{
    float white[4] = {1, 1, 1, 1};
    const struct rg_picture map = {.width = 1, .height = 1, .channels = 4, .texels = white};
    const struct rg_write_options options = {0};
    if (!rg_picture_write(map_path, &map, &options))
        exit(1);
}

int main(int argc, char **argv)
{
    snprintf(map_path, sizeof(map_path), "test_seams_%ld.exr", (long)getpid());
    write_map();
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_seam_is_seen),
        cmocka_unit_test(test_nothing_pops),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    remove(map_path);
    return status;
}
