// Pictures of streaks against an oracle that draws each pixel in double precision: oracle DEVICE.
// Places of drops are read back (tests/core/techniques/streaks/particles.c checks them). The oracle
// does all else, from the camera to the light that reaches the eye.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/core/techniques/streaks/picture/given.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846;

static char path[64];

// --- lights ---

enum { LAMP = 1, SPOT = 2, SUN = 4, SKY = 8, ALL = LAMP | SPOT | SUN | SKY };

// A lamp among the drops on the left; a spot from the right that lights a part of them; a sun from
// behind on the right.
static const struct streak_light lights[] = {
    {STREAK_LAMP, {1.5, 6, -1}, {0, 0, 0}, {30, 20, 10}, 0, 0},
    {STREAK_SPOT, {-3, 15, -14}, {2 / 7.0, -3 / 7.0, 6 / 7.0}, {200, 300, 400}, 8, 45},
    {STREAK_SUN, {0, 0, 0}, {0.48, -0.6, -0.64}, {1, 2, 1.5}, 0, 0},
};

// --- the drops ---

static struct streak_drop *drops_of(const struct streaks *s, int *count)
{
    const struct rain_places places = rain_read_places(s);
    struct streak_drop *drops = calloc((size_t)places.count, sizeof(*drops));
    assert_non_null(drops);
    *count = 0;
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        if ((int)place[5] != STREAKS_DROP)
            continue;
        struct streak_drop *drop = &drops[(*count)++];
        const double rain[3] = {(double)place[0], (double)place[1], (double)place[2]};
        rg_rain_world_point(&s->space, rain, drop->end);
        drop->fall_m = s->settings.fall_speed_m_s * s->settings.exposure_s;
        drop->cut_m = (double)place[2] - (double)place[3];
        drop->radius_m = s->settings.drop_radius_mm / 1000;
        drop->weight = 1;
        drop->oscillation = (int)place[7];
        drop->turn = (double)place[7] - floor((double)place[7]);
        // Rayleigh's frequency for water.
        drop->cycles =
            sqrt(8 * 0.0728 / (1000 * pow(drop->radius_m, 3))) / (2 * pi) * s->settings.exposure_s;
    }
    free(places.words);
    return drops;
}

// --- comparing ---

struct tally {
    int pixels, off, stray;
    double due, is;
};

static void compare(const struct streak_pixel *due, const struct rain_texels *dry,
                    const struct rain_texels *lit, struct tally *tally)
{
    for (int i = 0; i < RAIN_TEXELS; i++) {
        double error = 0, halves = 0;
        const int x = i % RAIN_WIDTH, y = i / RAIN_WIDTH;
        for (int c = 0; c < 3; c++) {
            const double is = rain_texel(lit, x, y, c), was = rain_texel(dry, x, y, c);
            error = fmax(error, fabs(is - due[i].light[c]));
            halves = fmax(halves, due[i].light[c] * 0x1p-10 * due[i].streaks);
            tally->due += due[i].light[c] - was;
            tally->is += is - was;
            tally->stray += !due[i].streaks && is != was;
        }
        tally->pixels += due[i].streaks > 0;
        if (due[i].streaks) {
            tally->off += error > 0.01 * due[i].peak + halves;
        }
    }
}

static struct streak_pixel *pixels_of(const struct rain_texels *dry)
{
    struct streak_pixel *pixels = calloc(RAIN_TEXELS, sizeof(*pixels));
    assert_non_null(pixels);
    for (int i = 0; i < 3 * RAIN_TEXELS; i++)
        pixels[i / 3].light[i % 3] = rain_texel(dry, i / 3 % RAIN_WIDTH, i / 3 / RAIN_WIDTH, i % 3);
    return pixels;
}

// Draws rain with these lights, and adds up its differences from the oracle's.
static void draw_both(int kinds, int taps, const char *settings, struct tally *tally)
{
    char all[800];
    struct streak_light shine[3];
    const int count = given_lights(path, lights, 3, kinds, shine);
    snprintf(all, sizeof(all),
             "state=on geometry=off time=night splashes=off streak_gain=500 "
             "taps=%d lights=%d %s%s rain_width_m=6 rain_depth_m=30 rain_height_m=60 "
             "local_height_m=40 culling_radius_m=30 eye_z_m=-26 target_z_m=0 %s",
             taps, count, count ? "lights_file=" : "", count ? path : "", settings);
    struct streaks *s = rain_open(all);
    rain_step(s, 3);
    for (int c = 0; c < 3; c++)
        (&s->params.sky_r)[c] = kinds & SKY ? (float)(c + 1) : 0.0f;
    struct rain_texels *lit = rain_read(s);
    s->params.drops = 0;
    struct rain_texels *dry = rain_read(s);
    struct streak_view view = given_view(s);
    view.lights = shine;
    view.light_count = count;
    for (int c = 0; c < 3; c++)
        view.sky[c] = kinds & SKY ? c + 1 : 0;
    s->params.drops = 1;
    int drop_count;
    struct streak_drop *drops = drops_of(s, &drop_count);
    struct streak_pixel *due = pixels_of(dry);
    streak_picture_draw(&view, given_atlas(), drops, drop_count, due);
    compare(due, dry, lit, tally);
    free(due);
    free(drops);
    free(lit);
    free(dry);
    rain_close(s);
}

#define NEAR   "view_angle_deg=3 drop_radius_mm=10 drops_m2_s=60 "
#define BESIDE "eye_y_m=5 target_y_m=5 "

static const char *const views[] = {
    BESIDE NEAR "eye_z_m=-20",
    BESIDE "view_angle_deg=16 drop_radius_mm=3 drops_m2_s=100 exposure_s=0.05",
    BESIDE NEAR "target_y_m=3 eye_y_m=1 drop_radius_mm=4",
    "eye_y_m=4 target_y_m=22 eye_z_m=-22 streak_opacity=8 " NEAR,
    "eye_y_m=28 target_y_m=4 eye_z_m=-22 streak_opacity=8 " NEAR,
    "eye_y_m=4 target_y_m=22 eye_z_m=-22 view_below=absolute " NEAR,
    "eye_y_m=9 target_y_m=5 slant_deg=30 slant_azimuth_deg=60 " NEAR,
    // The ground cuts streaks off.
    "eye_y_m=2 target_y_m=0.6 exposure_s=0.1 view_angle_deg=8 drop_radius_mm=6 drops_m2_s=60",
};

static void expect_equal(const char *about, int kinds, int taps)
{
    struct tally sum = {0};
    for (size_t i = 0; i < sizeof(views) / sizeof(views[0]); i++) {
        struct tally one = {0};
        draw_both(kinds, taps, views[i], &one);
        assert_above(one.pixels, 300);
        sum.pixels += one.pixels;
        sum.off += one.off;
        sum.stray += one.stray;
        sum.due += one.due;
        sum.is += one.is;
    }
    const double bias = sum.is / sum.due - 1;
    print_message("%s, %d taps: %d pixels, %d off, %d stray, bias %.4f %%\n", about, taps,
                  sum.pixels, sum.off, sum.stray, 100 * bias);
    assert_at_most(sum.off + sum.stray, 0.001 * sum.pixels);
    assert_at_most(fabs(bias), 0.002);
}

static void test_sky(void **state)
{
    (void)state;
    // The sky does not depend on the number of textures for a light.
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

int main(int argc, char **argv)
{
    snprintf(path, sizeof(path), "test_oracle_%ld.json", (long)getpid());
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sky), cmocka_unit_test(test_lamp), cmocka_unit_test(test_spot),
        cmocka_unit_test(test_sun), cmocka_unit_test(test_all),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    given_atlas_free();
    remove(path);
    return status;
}
