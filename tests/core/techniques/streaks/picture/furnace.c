// Furnaces, whose light needs no oracle: furnace DEVICE. Rain in front of a background as bright as
// the sky is not seen. Suns that together make a sky light rain as the sky does. Colours of lights
// are radiances of a white matt surface (docs/lights.md).
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846;

// One file for each process, since tests of several devices run side by side.
static char path[64];

enum { SUNS = 16 }; // the most in a file

struct sun {
    double direction[3]; // in which its light travels
    double colour;
};

static void write_lights(const struct sun *suns, int count, const float sky[3])
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "{\"lights\": [");
    for (int i = 0; i < count; i++)
        fprintf(file,
                "%s{\"type\": \"sun\", \"direction\": [%.9g, %.9g, %.9g], "
                "\"colour\": [%.9g, %.9g, %.9g], \"shadows\": false}",
                i ? ", " : "", suns[i].direction[0], suns[i].direction[1], suns[i].direction[2],
                suns[i].colour, suns[i].colour, suns[i].colour);
    fprintf(file, "], \"sky\": {\"colour\": [%.9g, %.9g, %.9g]}}\n", (double)sky[0], (double)sky[1],
            (double)sky[2]);
    assert_int_equal(fclose(file), 0);
}

static struct rain_texels *draw(const char *settings)
{
    char all[512];
    snprintf(all, sizeof(all), "geometry=off lights_file=%s %s", path, settings);
    return rain_draw_at(all, 3);
}

static const struct sun none = {{0, -1, 0}, 0};

// --- in front of a background as bright as the sky ---

// The difference of a picture from its background, as shares of it: the largest, and the mean,
// which counts darker pixels as positive.
struct distance {
    double farthest, mean;
};

static struct distance distance_of(const struct rain_texels *picture, const float background[3])
{
    struct distance d = {0, 0};
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            for (int c = 0; c < 3; c++) {
                const double off = 1 - rain_texel(picture, x, y, c) / (double)background[c];
                d.farthest = fmax(d.farthest, fabs(off));
                d.mean += off / (3.0 * RAIN_TEXELS);
            }
    return d;
}

// From the side, above and below, with each number of textures.
static const char *const views[] = {
    "taps=2 target_y_m=3 target_z_m=40",
    "taps=4 eye_y_m=4 target_y_m=0 target_z_m=5",
    "taps=8 eye_y_m=2 target_y_m=14 target_z_m=8",
};
enum { VIEWS = sizeof(views) / sizeof(views[0]) };

// The picture is rounded to halves once: by less than a thousandth of the background.
static void expect_unseen(const char *what, const char *view, const float sky[3])
{
    static const float dark[3] = {0, 0, 0};
    char settings[384];
    snprintf(settings, sizeof(settings),
             "time=day streak_gain=1 drop_radius_mm=10 drops_m2_s=600 %s %s", what, view);
    write_lights(&none, 1, sky);
    struct rain_texels *picture = draw(settings);
    const struct distance even = distance_of(picture, sky);
    free(picture);
    write_lights(&none, 1, dark);
    picture = draw(settings);
    const struct distance shaded = distance_of(picture, sky);
    free(picture);
    // Black rain is seen, which proves that there is rain.
    assert_above(shaded.mean, 0.02);
    if (!(even.farthest < 1 / 255.0 && fabs(even.mean) < 0.005 * shaded.mean + 1e-3))
        fail_msg("%s, %s: rain is seen before its own sky, by %g of it, and %g in the mean, of %g",
                 what, view, even.farthest, even.mean, shaded.mean);
}

static void test_white_rain_before_white(void **state)
{
    (void)state;
    const struct scenery_sky day = scenery_day().sky;
    const float horizon[3] = {day.horizon_r, day.horizon_g, day.horizon_b};
    for (int v = 0; v < VIEWS; v++)
        expect_unseen("splash_gain=1 splash_opacity=1", views[v], horizon);
    // Drops that stand for a hundred each.
    expect_unseen("drops=off drop_radius_mm=1.6 spectrum=marshall-palmer rain_mm_h=100 "
                  "kept_share=0.01 splash_width_mm=240 culling_radius_m=20",
                  views[1], horizon);
    expect_unseen("splashes=off drop_radius_mm=1.6 spectrum=marshall-palmer rain_mm_h=100 "
                  "kept_share=0.001 culling_radius_m=20",
                  views[0], horizon);
    expect_unseen("drops=off splashes=off far_layers=3", views[0], horizon);
}

// --- suns that are a sky ---

static double light_of(const struct rain_texels *picture)
{
    double sum = 0;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            sum += rain_texel(picture, x, y, 1);
    return sum;
}

static double light_with(const struct sun *suns, int count, const float sky[3],
                         const char *settings)
{
    write_lights(suns, count, sky);
    struct rain_texels *picture = draw(settings);
    const double light = light_of(picture);
    free(picture);
    return light;
}

// Rings of suns about the vertical, 20 degrees apart, and one at each pole. Each is as bright as
// its part of a sphere of radiance 1.
static int make_suns(struct sun *suns)
{
    int count = 0;
    for (int elevation = -90; elevation <= 90; elevation += 20) {
        const int around = abs(elevation) == 90 ? 1 : 18;
        const double low = fmax(elevation - 10, -90) * pi / 180,
                     high = fmin(elevation + 10, 90) * pi / 180, up = elevation * pi / 180;
        for (int i = 0; i < around; i++) {
            const double azimuth = (20 * i + 7) * pi / 180;
            suns[count++] =
                (struct sun){{-cos(up) * sin(azimuth), -sin(up), -cos(up) * cos(azimuth)},
                             2 * pi * (sin(high) - sin(low)) / around / pi};
        }
    }
    return count;
}

static void expect_as_sky(const char *what, const char *view)
{
    static const float dark[3] = {0, 0, 0}, white[3] = {1, 1, 1};
    struct sun suns[200];
    const int count = make_suns(suns);
    char settings[384];
    // So much light that the background does not count.
    snprintf(settings, sizeof(settings),
             "time=night streak_gain=300 splash_gain=100 streak_opacity=0 splash_opacity=0 %s %s",
             what, view);
    const double dry = light_with(&none, 1, dark, settings);
    const double sky = light_with(&none, 1, white, settings) - dry;
    double sum = 0;
    for (int first = 0; first < count; first += SUNS)
        sum +=
            light_with(suns + first, count - first < SUNS ? count - first : SUNS, dark, settings) -
            dry;
    assert_above(sky, 0.1 * dry);
    if (!(fabs(sum / sky - 1) < 0.03))
        fail_msg("%s, %s: suns make %.3f of the sky's light", what, view, sum / sky);
}

static void test_suns_light_streaks_as_a_sky(void **state)
{
    (void)state;
    for (int v = 0; v < VIEWS; v++)
        expect_as_sky("splashes=off", views[v]);
}

static void test_suns_light_splashes_as_a_sky(void **state)
{
    (void)state;
    expect_as_sky("drops=off", views[1]);
}

static void test_suns_light_far_rain_as_a_sky(void **state)
{
    (void)state;
    expect_as_sky("drops=off splashes=off far_layers=1 drops_m2_s=2000 drop_radius_mm=3", views[0]);
}

int main(int argc, char **argv)
{
    snprintf(path, sizeof(path), "test_furnace_%ld.json", (long)getpid());
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_white_rain_before_white),
        cmocka_unit_test(test_suns_light_streaks_as_a_sky),
        cmocka_unit_test(test_suns_light_splashes_as_a_sky),
        cmocka_unit_test(test_suns_light_far_rain_as_a_sky),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    remove(path);
    return status;
}
