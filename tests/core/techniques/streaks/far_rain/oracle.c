// Pictures of far rain against an oracle that draws each pixel in double precision: oracle DEVICE.
// The rain is so dense that every pixel has its mean light; meet.c checks variation between pixels
// against drops.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/image/files/io.h"
#include "tests/core/techniques/streaks/picture/given.h"
#include "tests/oracle/streaks/far.h"
#include "tests/tools/expect.h"

static char lights_path[64], map_path[64];
static struct streak_means means;

enum { LAMP = 1, SPOT = 2, SUN = 4, SKY = 8, ALL = LAMP | SPOT | SUN | SKY };

// A lamp beside the view, a spot from the right whose cone ends inside the picture, a sun from
// behind.
static const struct streak_light lights[] = {
    {STREAK_LAMP, {-12, 46, 4}, {0, 0, 0}, {30, 20, 10}, 0, 0},
    {STREAK_SPOT, {-16, 45, -4}, {2 / 7.0, -3 / 7.0, 6 / 7.0}, {200, 300, 400}, 8, 45},
    {STREAK_SUN, {0, 0, 0}, {0.48, -0.6, -0.64}, {1, 2, 1.5}, 0, 0},
};

static const double nearest_m = 8, slab_m = 2;
enum { LAYERS = 2 };

// Drops in a cubic metre, more than the settings have room for.
static const double drops_m3 = 1e10;

#define DENSE                                                                                      \
    "geometry=off drops=off splashes=off time=night rain_width_m=90 rain_depth_m=90 "              \
    "rain_height_m=80 packets=world local_height_m=0.5 drops_m2_s=1 density_map=%s "               \
    "exposure_s=0.02 culling_radius_m=8 far_layers=2 drop_radius_mm=5 streak_gain=0.000002 "       \
    "eye_x_m=0.3 eye_y_m=40 eye_z_m=-0.5 target_x_m=0 target_y_m=40 target_z_m=40 "                \
    "view_angle_deg=20 "

// Pixels in whose slabs a light's nearest cell changes are counted for themselves, if two taps show
// the nearest cell alone.
struct tally {
    int pixels, off, changing, changing_off;
    double due, is, most_off;
};

static void compare(const struct streak_view *view, const struct streak_far *far,
                    const struct rain_texels *dry, const struct rain_texels *wet,
                    struct tally *tally)
{
    // Every second column, since the oracle evaluates each light at so many places of a ray.
    for (int i = 0; i < RAIN_TEXELS; i += 2) {
        const int x = i % RAIN_WIDTH, y = i / RAIN_WIDTH;
        double was[3], due[3], most = 0, error = 0;
        for (int c = 0; c < 3; c++)
            due[c] = was[c] = rain_texel(dry, x, y, c);
        const bool changes = streak_far_draw(view, far, &means, x, y, due) && view->taps == 2;
        for (int c = 0; c < 3; c++) {
            const double is = rain_texel(wet, x, y, c);
            most = fmax(most, fabs(due[c] - was[c]));
            error = fmax(error, fabs(is - due[c]));
            tally->due += due[c] - was[c];
            tally->is += is - was[c];
        }
        assert_above(most, 0);
        tally->pixels += !changes;
        tally->changing += changes;
        *(changes ? &tally->changing_off : &tally->off) += error > 0.01 * most;
        if (changes)
            tally->most_off = fmax(tally->most_off, error / most);
    }
}

static void draw_both(int kinds, const char *settings, struct tally *tally)
{
    char all[900];
    struct streak_light shine[3];
    const int count = given_lights(lights_path, lights, 3, kinds, shine);
    snprintf(all, sizeof(all), DENSE "lights=%d %s%s %s", map_path, count,
             count ? "lights_file=" : "", count ? lights_path : "", settings);
    struct streaks *s = rain_open(all);
    rain_step(s, 3);
    s->sizes.drops_m3 = drops_m3;
    for (int c = 0; c < 3; c++)
        (&s->params.sky_r)[c] = kinds & SKY ? (float)(c + 1) : 0.0f;
    struct rain_texels *wet = rain_read(s);
    s->settings.far_layers = 0;
    struct rain_texels *dry = rain_read(s);
    struct streak_view view = given_view(s);
    view.lights = shine;
    view.light_count = count;
    struct streak_far far = {nearest_m, nearest_m * (1 + LAYERS),          slab_m,
                             drops_m3,  s->settings.drop_radius_mm / 1000, {{0}},
                             {0}};
    for (int c = 0; c < 3; c++) {
        view.sky[c] = kinds & SKY ? c + 1 : 0;
        far.axes[0][c] = s->space.x[c];
        far.axes[1][c] = s->space.y[c];
    }
    double eye[3];
    rg_rain_point(&s->space, view.eye, eye);
    far.eye[0] = eye[0];
    far.eye[1] = eye[1];
    compare(&view, &far, dry, wet, tally);
    free(wet);
    free(dry);
    rain_close(s);
}

static const char *const views[] = {
    "",
    "target_x_m=40 target_z_m=36 streak_opacity=0.000002",
    "target_y_m=15 eye_y_m=50 streak_opacity=0.000002",
    "target_y_m=65 eye_y_m=25",
    "target_y_m=65 eye_y_m=25 view_below=absolute",
    "target_x_m=40 target_z_m=-40 slant_deg=20 slant_azimuth_deg=60",
};

static void expect_equal(const char *about, int kinds, int taps)
{
    struct tally sum = {0};
    for (size_t i = 0; i < sizeof(views) / sizeof(views[0]); i++) {
        char settings[200];
        snprintf(settings, sizeof(settings), "taps=%d %s", taps, views[i]);
        draw_both(kinds, settings, &sum);
    }
    const double bias = sum.is / sum.due - 1;
    print_message("%s, %d taps: %d pixels, %d off; %d change, %d of them off, by %.3f at most; "
                  "bias %.4f %%\n",
                  about, taps, sum.pixels, sum.off, sum.changing, sum.changing_off, sum.most_off,
                  100 * bias);
    assert_at_most(sum.off, 0.001 * sum.pixels);
    // There the program shares the drops of half a slab between two cells as if the light's angle
    // went evenly along it: 0.12 % of these pixels are off under a lamp, 0.27 % under a spot.
    assert_at_most(sum.changing_off, 0.003 * sum.changing);
    assert_at_most(sum.most_off, 0.06);
    assert_at_most(fabs(bias), 0.002);
}

static void test_sky(void **state)
{
    (void)state;
    expect_equal("sky", SKY, 2);
}

static void test_lamp(void **state)
{
    (void)state;
    for (int taps = 2; taps <= 8; taps *= 2)
        expect_equal("lamp", LAMP, taps);
}

static void test_spot(void **state)
{
    (void)state;
    for (int taps = 2; taps <= 8; taps *= 2)
        expect_equal("spot", SPOT, taps);
}

static void test_sun(void **state)
{
    (void)state;
    for (int taps = 2; taps <= 8; taps *= 2)
        expect_equal("sun", SUN, taps);
}

static void test_all(void **state)
{
    (void)state;
    expect_equal("all", ALL, 8);
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

static int find_means(void **state)
{
    (void)state;
    streak_means_find(given_atlas(), &means);
    return 0;
}

int main(int argc, char **argv)
{
    snprintf(lights_path, sizeof(lights_path), "test_far_oracle_%ld.json", (long)getpid());
    snprintf(map_path, sizeof(map_path), "test_far_oracle_%ld.exr", (long)getpid());
    write_map();
    struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(test_sky, find_means),
        cmocka_unit_test(test_lamp),
        cmocka_unit_test(test_spot),
        cmocka_unit_test(test_sun),
        cmocka_unit_test(test_all),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    given_atlas_free();
    remove(lights_path);
    remove(map_path);
    return status;
}
