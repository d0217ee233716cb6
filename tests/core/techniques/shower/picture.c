// Each drop's place, pixels and colour against the oracle: shower picture DEVICE.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/shower/rig.h"
#include "tests/oracle/raster.h"
#include "tests/tools/expect.h"

enum { WIDTH = 320, HEIGHT = 180, ACROSS = 4, DOWN = 3, DROPS = ACROSS * DOWN };

// A shape on the screen, in pixels.
struct shape {
    double corners[4][2];
    struct oracle_streak streak;
    bool is_quad;
};

static struct shape shape_of(const struct oracle_streak *s, bool is_quad)
{
    const double x = s->high[0] - s->low[0], y = s->high[1] - s->low[1];
    const double wide = is_quad ? fmax(s->width_px, 1) : 1, length = hypot(x, y);
    // A line has one pixel in each row, or in each column if it is flatter.
    const double line_x = fabs(x) <= fabs(y) ? 0.5 : 0, line_y = 0.5 - line_x;
    const double beside_x = is_quad ? -y / length * wide / 2 : line_x;
    const double beside_y = is_quad ? x / length * wide / 2 : line_y;
    return (struct shape){{{s->low[0] - beside_x, s->low[1] - beside_y},
                           {s->high[0] - beside_x, s->high[1] - beside_y},
                           {s->high[0] + beside_x, s->high[1] + beside_y},
                           {s->low[0] + beside_x, s->low[1] + beside_y}},
                          *s,
                          is_quad};
}

// A drop's texture along one of its sides, interpolated between centres of texels.
static double texel(int i, int texels, int power)
{
    const double t = 2 * (i + 0.5) / texels - 1;
    return 1 - pow(t, power);
}

static double along(double share, int texels, int power)
{
    const double at = fmin(fmax(share * texels - 0.5, 0), texels - 1);
    const int low = (int)fmin(floor(at), texels - 2);
    return texel(low, texels, power) +
           (at - low) * (texel(low + 1, texels, power) - texel(low, texels, power));
}

static double opacity_at(const struct shape *s, double opacity, int px, int py)
{
    const double narrow = fmin(s->streak.width_px, 1) * opacity;
    const double x = s->streak.high[0] - s->streak.low[0], y = s->streak.high[1] - s->streak.low[1];
    const double to_x = px + 0.5 - s->streak.low[0], to_y = py + 0.5 - s->streak.low[1];
    const double length = hypot(x, y), wide = fmax(s->streak.width_px, 1);
    const double u = (to_y * x - to_x * y) / length / wide + 0.5;
    const double v = (to_x * x + to_y * y) / (length * length);
    const double mean = 2.0 / 3 * 4 / 5; // a parabola across, and a curve of degree 4 along
    return narrow * (s->is_quad ? along(u, 16, 2) * along(v, 64, 4) : mean);
}

struct texels {
    uint16_t halves[WIDTH * HEIGHT * 4];
};

static double light_of(const struct texels *t, int px, int py, int colour)
{
    return (double)rg_unpack_half(t->halves[4 * (py * WIDTH + px) + colour]);
}

// A pixel is the sky with at most one drop in front of it. Returns whether there is one.
static bool expect_pixel(const struct shower *s, const struct texels *t, const struct shape *shapes,
                         int count, int px, int py)
{
    double opacity = 0;
    for (int i = 0; i < count; i++) {
        struct oracle_point corners[4];
        for (int k = 0; k < 4; k++)
            corners[k] = (struct oracle_point){llround(shapes[i].corners[k][0] * 256),
                                               llround(shapes[i].corners[k][1] * 256)};
        if (oracle_outline_px(corners, 4, px, py) < 1.0 / 24)
            return false;
        if (oracle_covers(corners, 4, px, py))
            opacity = opacity_at(&shapes[i], s->settings.opacity, px, py);
    }
    for (int colour = 0; colour < 3; colour++) {
        const double sky = pour_sky(colour);
        const double due = sky + opacity * (pour_light(s, colour) - sky);
        const double found = light_of(t, px, py, colour);
        if (!(fabs(found - due) <= 0.012 * due))
            fail_msg("pixel %d %d, colour %d: %g, not %g", px, py, colour, found, due);
    }
    return opacity > 0;
}

// Near and far drops, narrow and wide, which do not meet on the screen.
static void put_drops(struct shower *s, struct shape *shapes)
{
    static const double ahead[DROPS] = {1.2, 12, 40, 3, 70, 6, 2, 20, 55, 4.5, 9, 28};
    struct oracle_drop drops[DROPS];
    const struct oracle_rain r = pour_oracle(s);
    for (int i = 0; i < DROPS; i++) {
        const struct oracle_sight at = {ahead[i], (i % ACROSS + 0.53) * 2 / ACROSS - 1,
                                        ((double)(i / ACROSS) + 0.31) * 2 / DOWN - 1};
        drops[i] = oracle_drop_at(&r, &at);
        drops[i].fall_m_s = s->settings.fall_m_s * oracle_share(&r, &drops[i]);
        const struct oracle_streak streak = oracle_streak_of(&r, &drops[i]);
        shapes[i] = shape_of(&streak, s->settings.shape == SHOWER_OLD);
    }
    pour_put(s, drops, DROPS);
}

static int expect_picture(const char *settings)
{
    char all[512];
    struct shape shapes[DROPS];
    // One slot more than drops: the spare slot's place is in the middle of the view, and must not
    // be drawn.
    snprintf(all, sizeof(all),
             "particles=%d variation=0 drop_height_m=0.5 light=20 opacity=0.9 eye_x_m=0 eye_y_m=1 "
             "eye_z_m=12 heading_deg=0 %s",
             DROPS + 1, settings);
    struct shower *s = pour_open(all, WIDTH, HEIGHT);
    struct texels *t = malloc(sizeof(*t));
    int covered = 0;
    assert_non_null(t);
    pour_step(s, 1);
    put_drops(s, shapes);
    assert_true(s->base.technique->draw(&s->base));
    assert_true(rg_image_read(s->base.target, 0, 0, t->halves));
    for (int py = 0; py < HEIGHT; py++)
        for (int px = 0; px < WIDTH; px++)
            covered += expect_pixel(s, t, shapes, DROPS, px, py);
    free(t);
    pour_close(s);
    print_message("%s: %d pixels\n", settings, covered);
    return covered;
}

static void segments_are_seen_where_drops_are(void **state)
{
    (void)state;
    assert_above(expect_picture("shape=segments wind_m_s=2 drop_width_m=0.004"), 80);
    assert_above(expect_picture("shape=segments wind_m_s=9 wind_deg=160 fall_m_s=4"), 60);
    assert_above(expect_picture("shape=segments layers=off drop_width_m=0.02 wind_deg=60"), 80);
}

static void quads_are_seen_where_drops_are(void **state)
{
    (void)state;
    assert_above(expect_picture("shape=quads wind_m_s=2 drop_width_m=0.05"), 200);
    assert_above(expect_picture("shape=quads wind_m_s=7 wind_deg=200 fall_m_s=6 layers=off "
                                "drop_width_m=0.08"),
                 300);
    assert_above(expect_picture("shape=quads drop_width_m=0.004 wind_deg=90"), 50);
}

// Drops blend over each other in the order of their slots.
static void drops_hide_each_other(void **state)
{
    (void)state;
    struct shower *s = pour_open("particles=2 variation=0 drop_height_m=1 light=20 opacity=0.8 "
                                 "drop_width_m=0.5 shape=segments wind_m_s=0 layers=off",
                                 WIDTH, HEIGHT);
    struct texels *t = malloc(sizeof(*t));
    assert_non_null(t);
    pour_step(s, 1);
    const struct oracle_rain r = pour_oracle(s);
    const struct oracle_sight at = {5, 0.5 / (WIDTH / 2), 0};
    struct oracle_drop both[2] = {oracle_drop_at(&r, &at), oracle_drop_at(&r, &at)};
    both[0].fall_m_s = both[1].fall_m_s = 10;
    pour_put(s, both, 2);
    assert_true(s->base.technique->draw(&s->base));
    assert_true(rg_image_read(s->base.target, 0, 0, t->halves));
    const double through = 1 - 0.8 * 2.0 / 3 * 4 / 5;
    for (int colour = 0; colour < 3; colour++) {
        const double sky = pour_sky(colour), light = pour_light(s, colour);
        pour_expect("pixel", light_of(t, WIDTH / 2, HEIGHT / 2 - 10, colour),
                    light + (sky - light) * through * through, 0.01 * light);
    }
    free(t);
    pour_close(s);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_are_seen_where_drops_are),
        cmocka_unit_test(quads_are_seen_where_drops_are),
        cmocka_unit_test(drops_hide_each_other),
    };
    return pour_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
