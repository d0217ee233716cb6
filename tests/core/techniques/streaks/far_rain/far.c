// Rain beyond the culling radius: far DEVICE. The light that layers hide is compared with the
// cross-sections of the drops that they stand for.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846;

// Rain dense enough for halves, and black: the picture over its sky is the light that comes
// through. All visible texels of the map are near 1.
#define FAR                                                                                        \
    "geometry=off drops=off splashes=off environment_light=off lights=0 drop_radius_mm=10 "        \
    "rain_width_m=4000 rain_depth_m=4000 rain_height_m=60 packets=grid local_height_m=2 "          \
    "eye_y_m=30 target_y_m=30 target_z_m=40 view_angle_deg=20 culling_radius_m=12 drops_m2_s=20 "

static struct streaks *open_far(const char *settings)
{
    char all[800];
    snprintf(all, sizeof(all), FAR "%s", settings);
    return rain_open(all);
}

// --- the light that comes through ---

struct seen {
    double share[RAIN_HEIGHT][RAIN_WIDTH]; // of the sky's light, after all layers
};

// Draws this frame with so many layers, at most those that were opened. The caller frees it.
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

static void test_layers_hide_what_their_drops_would(void **state)
{
    (void)state;
    static const struct {
        int layers;
        double drop_radius_mm, fall_m_s, opacity;
    } cases[] = {{1, 10, 8.16, 20}, {3, 10, 8.16, 10}, {2, 7, 6, 20}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char settings[256];
        snprintf(settings, sizeof(settings),
                 "far_layers=%d drop_radius_mm=%g fall_speed_m_s=%g streak_opacity=%g",
                 cases[i].layers, cases[i].drop_radius_mm, cases[i].fall_m_s, cases[i].opacity);
        struct streaks *s = open_far(settings);
        rain_step(s, 1);
        double hidden = 0;
        enum { FRAMES = 6 };
        for (int frame = 0; frame < FRAMES; frame++) {
            rain_step(s, 20);
            struct seen *seen = look(s, cases[i].layers);
            hidden += -log(average_of(seen).mean) / FRAMES;
            free(seen);
        }
        // Rays are slightly longer than the radius, since the camera sees 17 degrees to the sides.
        const double due = 20 / cases[i].fall_m_s * pi * pow(cases[i].drop_radius_mm / 1000, 2) *
                           12 * cases[i].layers * cases[i].opacity;
        if (!(hidden > 0.96 * due && hidden < 1.07 * due))
            fail_msg("%d layers hide %.3f of what their drops would", cases[i].layers,
                     hidden / due);
        rain_close(s);
    }
}

// --- how it falls ---

// The correlation of two pictures, with the second one moved by so many pixels.
static double alike(const struct seen *a, const struct seen *b, int right, int down)
{
    double ab = 0, aa = 0, bb = 0, ma = 0, mb = 0;
    int count = 0;
    for (int y = 20; y < RAIN_HEIGHT - 20; y++)
        for (int x = 20; x < RAIN_WIDTH - 20; x++) {
            const double va = a->share[y][x], vb = b->share[y + down][x + right];
            ab += va * vb;
            aa += va * va;
            bb += vb * vb;
            ma += va;
            mb += vb;
            count++;
        }
    return (ab - ma * mb / count) / sqrt((aa - ma * ma / count) * (bb - mb * mb / count));
}

// The move by which a picture is most like the picture one step later.
static void find_move(const char *settings, int *right, int *down)
{
    struct streaks *s = open_far(settings);
    rain_step(s, 3);
    struct seen *before = look(s, 1);
    rain_step(s, 1);
    struct seen *after = look(s, 1);
    double most = -1;
    for (int y = -12; y <= 12; y++)
        for (int x = -12; x <= 12; x++) {
            const double is = alike(before, after, x, y);
            if (is > most) {
                most = is;
                *right = x;
                *down = y;
            }
        }
    assert_above(most, 0.5);
    free(before);
    free(after);
    rain_close(s);
}

// In 1/60 s drops of 8.16 m/s fall 0.136 m. They are 12 to 24 m away, where 643 pixels a metre at
// one metre make that 3.6 to 7.3 pixels. Leaning rain also moves sideways.
static void test_rain_falls(void **state)
{
    (void)state;
    int right, down;
    find_move("far_layers=1 view_angle_deg=8 exposure_s=0.004 streak_opacity=8", &right, &down);
    print_message("it falls by %d pixels, and %d aside\n", down, right);
    assert_at_least(down, 3);
    assert_at_most(down, 8);
    assert_equals(right, 0);
    // Towards x, which is on the left for a viewer along z.
    find_move("far_layers=1 view_angle_deg=8 exposure_s=0.004 streak_opacity=8 slant_deg=45",
              &right, &down);
    print_message("it leans by %d pixels, and falls by %d\n", right, down);
    assert_at_least(down, 2);
    assert_at_most(down, 6);
    assert_at_most(right, -2);
    assert_at_least(right, -6);
}

// --- with a scene ---

// The distance of a pixel's surface from the observer, measured as the culling prism does, for a
// level camera that looks along z.
static double across_at(const struct streaks *s, const float *depths, int x, int y)
{
    const double near_m = (double)s->observer.camera.near_plane,
                 far_m = (double)s->observer.camera.far_plane,
                 depth = (double)depths[y * RAIN_WIDTH + x],
                 ahead = far_m * near_m / (far_m - depth * (far_m - near_m)),
                 metres_per_px = 2 * tan(35 * pi / 180) / RAIN_HEIGHT;
    return ahead * fmax(1, fabs(x + 0.5 - RAIN_WIDTH / 2) * metres_per_px);
}

// Pixels nearer than the first layer keep every bit; farther ones are dimmed.
static void test_layers_stand_in_the_scene(void **state)
{
    (void)state;
    static float depths[RAIN_TEXELS];
    struct streaks *s = open_far(
        "geometry=on far_layers=1 drops_m2_s=200 view_angle_deg=70 eye_y_m=3 target_y_m=3");
    rain_step(s, 1);
    struct rain_texels *wet = rain_read(s);
    assert_true(rg_image_read(rg_asset_find(&s->base, "depth")->image, 0, 0, depths));
    s->settings.far_layers = 0;
    struct rain_texels *dry = rain_read(s);
    int nearer = 0, farther = 0, dimmed = 0;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            const double across = across_at(s, depths, x, y);
            if (across < 0.999 * 12) {
                assert_memory_equal(wet->halves + 4 * (y * RAIN_WIDTH + x),
                                    dry->halves + 4 * (y * RAIN_WIDTH + x), 8);
                nearer++;
            } else if (across > 24 && rain_texel(dry, x, y, 1) > 0.001) {
                assert_at_most(rain_texel(wet, x, y, 1), rain_texel(dry, x, y, 1));
                dimmed += rain_texel(wet, x, y, 1) < rain_texel(dry, x, y, 1);
                farther++;
            }
        }
    assert_above(nearer, RAIN_TEXELS / 20);
    assert_above(farther, RAIN_TEXELS / 20);
    assert_above(dimmed, farther / 2);
    free(wet);
    free(dry);
    rain_close(s);
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layers_hide_what_their_drops_would),
        cmocka_unit_test(test_rain_falls),
        cmocka_unit_test(test_layers_stand_in_the_scene),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
