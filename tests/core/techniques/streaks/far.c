// Rain beyond the culling radius, as layers that fall: far DEVICE. What layers hide is
// held against the drops that they stand for; where they are, against cylinders in double
// precision.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/streaks/rig.h"

static const double pi = 3.14159265358979323846;

// Rain thick enough for halves, and black, so that a picture over its sky is what comes through.
#define FAR                                                                                        \
    "geometry=off drops=off splashes=off environment_light=off drop_radius_mm=10 rain_width_m=20 " \
    "rain_depth_m=20 rain_height_m=10 local_height_m=2 eye_y_m=3 target_y_m=3 target_z_m=40 "      \
    "culling_radius_m=12 drops_m2_s=600 "

static struct streaks *open_far(const char *settings)
{
    char all[512];
    snprintf(all, sizeof(all), FAR "%s", settings);
    return rain_open(all);
}

// --- what comes through ---

struct seen {
    double share[RAIN_HEIGHT][RAIN_WIDTH]; // of the sky's light, after all layers
};

// The picture of so many layers of the present frame, which must be no more than were opened. The
// caller frees it.
static struct seen *look(struct streaks *s, int layers)
{
    const double sky = (double)rg_unpack_half(rg_pack_half(scenery_day().sky.horizon_g));
    struct seen *seen = malloc(sizeof(*seen));
    assert_non_null(seen);
    s->settings.far_layers = layers;
    struct rain_texels *picture = rain_read(s);
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            seen->share[y][x] = rain_texel(picture, x, y, 1) / sky;
    free(picture);
    return seen;
}

// What halves cut off a layer's share at most.
static const double cut = 0x1p-10;

struct average {
    double mean, deviation;
};

static struct average average_of(const struct seen *seen)
{
    double sum = 0, squares = 0;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            sum += seen->share[y][x];
            squares += seen->share[y][x] * seen->share[y][x];
        }
    const double mean = sum / RAIN_TEXELS;
    return (struct average){mean, sqrt(squares / RAIN_TEXELS - mean * mean)};
}

// How far chance takes a picture's mean, five times over. A pixel lies between two cells of its
// column, so that its variance is half of a cell's or more; no pixels side by side share a column,
// and no more than two along it the size of a cell, so that no cell weighs more than two pixels:
// the mean's variance is at most 2 / n of a cell's.
static double chance_of(struct average average)
{
    return 5 * average.deviation * sqrt(2 * 2.0 / RAIN_TEXELS);
}

static void test_layers_hide_what_their_drops_would(void **state)
{
    (void)state;
    static const struct {
        int layers;
        double eye_x_m, drop_radius_mm, radius_m, fall_m_s, opacity;
    } cases[] = {
        {1, 0, 10, 12, 8.16, 1}, {3, 0, 10, 12, 8.16, 1}, {1, 5, 10, 12, 8.16, 1},
        {1, 0, 7, 20, 8.16, 1},  {2, 0, 10, 12, 6, 0.5},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char settings[256];
        snprintf(settings, sizeof(settings),
                 "far_layers=%d eye_x_m=%g target_x_m=%g drop_radius_mm=%g culling_radius_m=%g "
                 "fall_speed_m_s=%g streak_opacity=%g",
                 cases[i].layers, cases[i].eye_x_m, cases[i].eye_x_m, cases[i].drop_radius_mm,
                 cases[i].radius_m, cases[i].fall_m_s, cases[i].opacity);
        struct streaks *s = open_far(settings);
        rain_step(s, 1);
        struct seen *seen = look(s, cases[i].layers);
        const struct average average = average_of(seen);
        // The gradient falls from 1 in the middle to 0 at 10 m; drops that fall in a second through
        // a square metre are in as many metres as they fall.
        const double drops_m3 = 600 * (1 - cases[i].eye_x_m / 10) / cases[i].fall_m_s,
                     section_m2 = pi * pow(cases[i].drop_radius_mm / 1000, 2),
                     hidden = drops_m3 * section_m2 * cases[i].radius_m * cases[i].opacity;
        const double due = pow(1 - hidden, cases[i].layers);
        const double texel = 0.01; // of the map, whose densities have steps
        assert_true(fabs(average.mean - due) <
                    chance_of(average) + cases[i].layers * (cut + texel * hidden));
        free(seen);
        rain_close(s);
    }
}

// What layers hide, they light: with the sky's light times the gain.
static void test_layers_shine(void **state)
{
    (void)state;
    struct streaks *s = open_far("far_layers=1 environment_light=on streak_gain=3");
    rain_step(s, 1);
    struct seen *lit = look(s, 1);
    const struct scenery_look day = scenery_day();
    const double of_sky = (double)s->lights->sky[1] * 3 / (double)day.sky.horizon_g;
    s->params.sky_g = 0;
    struct seen *black = look(s, 1);
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            const double hidden = 1 - black->share[y][x];
            assert_true(hidden > 0.05);
            assert_true(fabs(lit->share[y][x] - black->share[y][x] - of_sky * hidden) <
                        cut * (2 + 2 * of_sky));
        }
    free(lit);
    free(black);
    rain_close(s);
}

// --- where layers are, and how they fall ---

enum { NEAR_LAYER, FAR_LAYER, LAYERS };

static const double radius_m = 12;

static double distance_of(int layer)
{
    return (layer + 1.5) * radius_m;
}

// Each layer for itself: the second is what comes through both, over what comes through the first.
static void look_at_layers(struct streaks *s, struct seen *layers[LAYERS])
{
    layers[NEAR_LAYER] = look(s, 1);
    layers[FAR_LAYER] = look(s, 2);
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            layers[FAR_LAYER]->share[y][x] /= layers[NEAR_LAYER]->share[y][x];
}

// How much two pictures of one layer differ, where the later has come down by `fallen` metres.
static struct average differing(const struct seen *sooner, const struct seen *later, int layer,
                                double fallen, double metres_per_px)
{
    double sum = 0, most = 0;
    int count = 0;
    for (int x = 0; x < RAIN_WIDTH; x++) {
        const double beside = (x + 0.5 - RAIN_WIDTH / 2) * metres_per_px;
        const double down = fallen / distance_of(layer) * hypot(1, beside) / metres_per_px;
        for (int y = 0; y + down < RAIN_HEIGHT - 1; y++) {
            const int row = y + (int)floor(down);
            const double t = down - floor(down);
            const double there =
                later->share[row][x] + (later->share[row + 1][x] - later->share[row][x]) * t;
            const double off = fabs(there - sooner->share[y][x]);
            sum += off;
            most = fmax(most, off);
            count++;
        }
    }
    assert_true(count > RAIN_TEXELS / 2);
    return (struct average){sum / count, most};
}

// A level camera that sees 45 degrees up and down: a pixel is 1/45 m wide, 1 m away.
static void test_layers_fall_at_the_drops_speed(void **state)
{
    (void)state;
    const int frames = 15;
    const double fall_m_s = 12, step_s = 1.0 / 60, cell_m = 4, fallen = fall_m_s * step_s * frames,
                 metres_per_px = 2.0 / RAIN_HEIGHT;
    struct streaks *s = open_far("far_layers=2 view_angle_deg=90 fall_speed_m_s=12 drops_m2_s=900 "
                                 "exposure_s=0.16666667"); // cells of 4 m, many pixels long
    struct seen *sooner[LAYERS], *later[LAYERS];
    rain_step(s, 1);
    look_at_layers(s, sooner);
    rain_step(s, frames);
    look_at_layers(s, later);
    for (int i = 0; i < LAYERS; i++) {
        // Between two rows a cell's smooth step strays from a line by an eighth of its bend.
        const double cell_px = cell_m / (distance_of(i) * metres_per_px),
                     hidden = 900 / fall_m_s * pi * 1e-4 * radius_m,
                     stray = hidden * 6 / (8 * cell_px * cell_px) + 4 * cut;
        const struct average moved = differing(sooner[i], later[i], i, fallen, metres_per_px),
                             stood = differing(sooner[i], later[i], i, 0, metres_per_px),
                             slow = differing(sooner[i], later[i], i, 0.9 * fallen, metres_per_px);
        assert_true(moved.deviation < stray);
        assert_true(stood.mean > 10 * moved.mean && slow.mean > 2 * moved.mean);
        free(sooner[i]);
        free(later[i]);
    }
    rain_close(s);
}

// Where a point of the nearest layer that pixel (x, y) shows is seen after it has come down by
// `fallen` along `fall`, by a camera that looks along z.
static void follow(double x, double y, const double fall[3], double fallen, double metres_per_px,
                   double to[2])
{
    const double ray[3] = {-(x - RAIN_WIDTH / 2.0) * metres_per_px,
                           -(y - RAIN_HEIGHT / 2.0) * metres_per_px, 1};
    const double along = ray[0] * fall[0] + ray[1] * fall[1] + ray[2] * fall[2];
    double across2 = 0, at[3];
    for (int i = 0; i < 3; i++)
        across2 += pow(ray[i] - along * fall[i], 2);
    for (int i = 0; i < 3; i++)
        at[i] = ray[i] * distance_of(NEAR_LAYER) / sqrt(across2) + fallen * fall[i];
    to[0] = RAIN_WIDTH / 2.0 - at[0] / at[2] / metres_per_px;
    to[1] = RAIN_HEIGHT / 2.0 - at[1] / at[2] / metres_per_px;
}

// Through a lens so long that a column of the pattern is five pixels wide.
static void test_layers_fall_with_leaning_rain(void **state)
{
    (void)state;
    static const struct {
        const char *settings;
        double slant_deg;
    } falls[] = {{"slant_deg=0", 0},
                 {"slant_deg=30 slant_azimuth_deg=0", 30},
                 {"slant_deg=40 slant_azimuth_deg=180", -40}};
    const int frames = 8;
    const double metres_per_px = 2 * tan(pi / 360) / RAIN_HEIGHT, fallen = 12 * 0.0005 * frames;
    for (size_t i = 0; i < sizeof(falls) / sizeof(falls[0]); i++) {
        const double slant = falls[i].slant_deg * pi / 180, fall[3] = {sin(slant), -cos(slant), 0};
        char settings[256];
        snprintf(
            settings, sizeof(settings),
            "far_layers=1 view_angle_deg=1 fall_speed_m_s=12 exposure_s=0.005 step_s=0.0005 %s",
            falls[i].settings);
        struct streaks *s = open_far(settings);
        rain_step(s, 1);
        struct seen *sooner = look(s, 1);
        rain_step(s, frames);
        struct seen *later = look(s, 1);
        double moved = 0, stood = 0;
        int count = 0;
        for (int y = 0; y < RAIN_HEIGHT; y++)
            for (int x = 0; x < RAIN_WIDTH; x++) {
                double to[2];
                follow(x + 0.5, y + 0.5, fall, fallen, metres_per_px, to);
                if (to[0] < 0 || to[0] >= RAIN_WIDTH || to[1] < 0 || to[1] >= RAIN_HEIGHT)
                    continue;
                moved += fabs(later->share[(int)to[1]][(int)to[0]] - sooner->share[y][x]);
                stood += fabs(later->share[y][x] - sooner->share[y][x]);
                count++;
            }
        assert_true(count > RAIN_TEXELS / 2 && stood > 0.005 * count);
        assert_true(moved < 0.3 * stood);
        free(sooner);
        free(later);
        rain_close(s);
    }
}

// All around, layers are equally dense, and no two pixels side by side show one column.
static void test_layers_have_no_seam(void **state)
{
    (void)state;
    enum { WAYS = 8 };
    struct seen *ways[WAYS];
    double sum = 0;
    struct streaks *s = open_far("far_layers=1 view_angle_deg=60");
    for (int i = 0; i < WAYS; i++) {
        s->camera.target[0] = (float)(40 * sin(2 * pi * i / WAYS));
        s->camera.target[2] = (float)(40 * cos(2 * pi * i / WAYS));
        rain_step(s, 1);
        ways[i] = look(s, 1);
        sum += average_of(ways[i]).mean;
        for (int x = 0; x + 1 < RAIN_WIDTH; x++) {
            double off = 0;
            for (int y = 0; y < RAIN_HEIGHT; y++)
                off += fabs(ways[i]->share[y][x + 1] - ways[i]->share[y][x]);
            assert_true(off > RAIN_HEIGHT * 0.2 * average_of(ways[i]).deviation);
        }
    }
    for (int i = 0; i < WAYS; i++) {
        const struct average average = average_of(ways[i]);
        assert_true(fabs(average.mean - sum / WAYS) < chance_of(average));
        free(ways[i]);
    }
    rain_close(s);
}

// --- with a scene ---

// How far a pixel's surface is from the observer, across the fall, through a level camera.
static double across_at(const struct streaks *s, const float *depths, int x, int y)
{
    const double near_m = (double)s->observer.camera.near_plane,
                 far_m = (double)s->observer.camera.far_plane,
                 depth = (double)depths[y * RAIN_WIDTH + x],
                 ahead = far_m * near_m / (far_m - depth * (far_m - near_m)),
                 metres_per_px = 2 * tan(35 * pi / 180) / RAIN_HEIGHT;
    return ahead * hypot(1, (x + 0.5 - RAIN_WIDTH / 2) * metres_per_px);
}

// What is nearer than the first layer is as it was, to the last bit; what is farther is dimmed.
static void test_layers_stand_in_the_scene(void **state)
{
    (void)state;
    static float depths[RAIN_TEXELS];
    const char *const scene = "geometry=on far_layers=%d";
    char settings[64];
    snprintf(settings, sizeof(settings), scene, 1);
    struct streaks *s = open_far(settings);
    rain_step(s, 1);
    struct rain_texels *wet = rain_read(s);
    assert_true(rg_image_read(rg_asset_find(&s->base, "depth")->image, 0, 0, depths));
    snprintf(settings, sizeof(settings), scene, 0);
    struct streaks *bare = open_far(settings);
    rain_step(bare, 1);
    struct rain_texels *dry = rain_read(bare);
    int nearer = 0, farther = 0;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            const double across = across_at(s, depths, x, y) / distance_of(NEAR_LAYER);
            const double before = rain_texel(dry, x, y, 1), after = rain_texel(wet, x, y, 1);
            if (across < 0.999) {
                assert_memory_equal(wet->halves + 4 * (y * RAIN_WIDTH + x),
                                    dry->halves + 4 * (y * RAIN_WIDTH + x), 8);
                nearer++;
            } else if (across > 1.001 && before > 0.001) {
                assert_true(after < 0.95 * before && after > 0.5 * before);
                farther++;
            }
        }
    assert_true(nearer > RAIN_TEXELS / 20 && farther > RAIN_TEXELS / 20);
    free(wet);
    free(dry);
    rain_close(bare);
    rain_close(s);
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layers_hide_what_their_drops_would),
        cmocka_unit_test(test_layers_shine),
        cmocka_unit_test(test_layers_fall_at_the_drops_speed),
        cmocka_unit_test(test_layers_fall_with_leaning_rain),
        cmocka_unit_test(test_layers_have_no_seam),
        cmocka_unit_test(test_layers_stand_in_the_scene),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
