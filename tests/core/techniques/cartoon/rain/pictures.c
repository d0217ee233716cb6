// Sprites on the picture: their places, turns and textures, and the things that hide them. Painted
// in double precision over the scene without rain.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/cartoon/rain/rig.h"

enum { SIZE_PX = 160, LEVELS = 7, FULL_PX = 64 };

static struct rg_device *device;

struct picture {
    double texels[SIZE_PX * SIZE_PX][4];
    bool is_doubtful[SIZE_PX * SIZE_PX];
};

static void read_target(struct cartoon *c, struct picture *p)
{
    assert_true(c->base.technique->draw(&c->base));
    uint16_t *halves = rig_texels(c, "target", 0, 0);
    for (int i = 0; i < SIZE_PX * SIZE_PX * 4; i++)
        p->texels[i / 4][i % 4] = rig_half(halves[i]);
    free(halves);
}

// A texture's texel, and values between texels; beyond an edge the edge's texels repeat.
static double texel_of(const uint8_t *texels, int px, int x, int y, int channel)
{
    const int column = x < 0 ? 0 : x >= px ? px - 1 : x, row = y < 0 ? 0 : y >= px ? px - 1 : y;
    return texels[4 * (row * px + column) + channel] / 255.0;
}

static double between(const uint8_t *texels, int px, double u, double v, int channel)
{
    const double x = u * px - 0.5, y = v * px - 0.5, dx = x - floor(x), dy = y - floor(y);
    const int column = (int)floor(x), row = (int)floor(y);
    const double above = (1 - dx) * texel_of(texels, px, column, row, channel) +
                         dx * texel_of(texels, px, column + 1, row, channel);
    const double below = (1 - dx) * texel_of(texels, px, column, row + 1, channel) +
                         dx * texel_of(texels, px, column + 1, row + 1, channel);
    return (1 - dy) * above + dy * below;
}

struct sprite {
    double x_px, y_px, side_px, along_x, along_y, depth, alpha;
    int layer;
};

// The level whose texels are nearest to a pixel's size, and whether two levels are about as near.
static int level_of(double side_px, bool *is_doubtful)
{
    const double level = fmin(fmax(log2(FULL_PX / side_px), 0), LEVELS - 1);
    *is_doubtful = fabs(level - floor(level) - 0.5) < 1e-3;
    return (int)floor(level + 0.5);
}

static void blend(const struct rainfall_eye *eye, const struct sprite *s, const uint8_t *texels,
                  int px, bool is_doubtful, struct picture *p)
{
    const int reach = (int)(0.75 * s->side_px) + 2;
    for (int y = (int)s->y_px - reach; y <= (int)s->y_px + reach; y++)
        for (int x = (int)s->x_px - reach; x <= (int)s->x_px + reach; x++) {
            if (x < 0 || y < 0 || x >= SIZE_PX || y >= SIZE_PX)
                continue;
            const int i = y * SIZE_PX + x;
            const double dx = (x + 0.5 - s->x_px) / s->side_px,
                         dy = (y + 0.5 - s->y_px) / s->side_px;
            // v runs along the sprite's direction, and u to its left on the screen.
            const double v = dx * s->along_x + dy * s->along_y + 0.5;
            const double u = dx * s->along_y - dy * s->along_x + 0.5;
            const double edge = fmin(fmin(u, 1 - u), fmin(v, 1 - v)) * s->side_px;
            const double before = (double)eye->depth[i] - s->depth;
            if (edge < -0.02 || before < -2e-6)
                continue;
            const double alpha = between(texels, px, u, v, 3) * s->alpha;
            if (alpha > 0)
                p->is_doubtful[i] |= is_doubtful || edge < 0.02 || before < 2e-6;
            for (int k = 0; k < 3; k++)
                p->texels[i][k] =
                    between(texels, px, u, v, k) * s->alpha + p->texels[i][k] * (1 - alpha);
        }
}

static void paint(struct cartoon *c, const struct rainfall_eye *eye, const struct sprite *s,
                  struct picture *p)
{
    bool is_doubtful;
    const int level = level_of(s->side_px, &is_doubtful);
    uint8_t *texels = rig_texels(c, "rain_textures", s->layer, level);
    blend(eye, s, texels, FULL_PX >> level, is_doubtful, p);
    free(texels);
}

// A square of this side in metres; its v runs along `towards` in the world.
static struct sprite square(const struct rainfall_eye *eye, struct rainfall_vector at,
                            double side_m, struct rainfall_vector towards)
{
    const struct rainfall_spot spot = rainfall_spot_of(eye, at);
    const double right = rainfall_dot(towards, eye->right), up = rainfall_dot(towards, eye->up);
    const double length = hypot(right, up);
    return (struct sprite){spot.x_px,
                           spot.y_px,
                           side_m * eye->focal_px / spot.distance_m,
                           right / length,
                           -up / length,
                           spot.depth,
                           1,
                           0};
}

static void paint_splash(struct cartoon *c, const struct rainfall_eye *eye, const cartoon_spray *d,
                         double size_m, struct picture *p)
{
    const struct rainfall_vector at = {(double)d->x, (double)d->y, (double)d->z};
    const struct rainfall_vector below = {-(double)d->nx, -(double)d->ny, -(double)d->nz};
    const double side_m = size_m * (0.4 + 0.6 * (double)d->weight);
    const double distance_m = rainfall_spot_of(eye, at).distance_m;
    struct sprite s = square(eye, at, side_m, below);
    s.depth = rainfall_depth_of(eye, distance_m - side_m / 2);
    s.alpha = (double)d->alpha;
    s.layer = 3 + 6 * d->pattern + d->texture;
    paint(c, eye, &s, p);
}

static void paint_drop(struct cartoon *c, const struct rainfall_eye *eye, const cartoon_raindrop *d,
                       double size_m, struct picture *p)
{
    struct sprite s =
        square(eye, rig_place(d), size_m * (0.4 + 0.6 * (double)d->size), rig_velocity(d));
    s.alpha = (double)d->alpha;
    s.layer = (double)d->size < 1.0 / 3 ? 0 : (double)d->size < 2.0 / 3 ? 1 : 2;
    if (rainfall_spot_of(eye, rig_place(d)).distance_m > eye->near_m)
        paint(c, eye, &s, p);
}

static void paint_rain(struct cartoon *c, double drop_m, double splash_m, struct picture *p)
{
    struct rig_rain rain = rig_look(c);
    const struct rainfall_eye eye = rig_eye(c);
    const int slots = rain.drop_slots;
    for (int i = 0; i < c->rain.sprays_before + rig_hits(c); i++) {
        const cartoon_spray *s = &rain.sprays[rain.living[slots + i]];
        if (s->state != CARTOON_DEATH)
            paint_splash(c, &eye, s, splash_m, p);
    }
    for (int i = 0; i < c->rain.drops; i++)
        if (rain.drops[rain.living[i]].state != CARTOON_DEATH)
            paint_drop(c, &eye, &rain.drops[rain.living[i]], drop_m, p);
    free((void *)eye.depth);
    rig_free(&rain);
}

static void expect_picture(const char *settings, double drop_m, double splash_m, int steps,
                           int least_wet)
{
    static struct picture due, found;
    char dry[512];
    snprintf(dry, sizeof(dry), "%s drops_s=0", settings);
    struct cartoon *without = rig_open(device, dry, SIZE_PX, SIZE_PX);
    struct cartoon *c = rig_open(device, settings, SIZE_PX, SIZE_PX);
    memset(&due, 0, sizeof(due));
    rig_step(c, steps);
    rig_step(without, steps);
    read_target(without, &due);
    found = due;
    paint_rain(c, drop_m, splash_m, &due);
    int wet = 0, doubtful = 0;
    struct picture *dry_one = malloc(sizeof(*dry_one));
    assert_non_null(dry_one);
    *dry_one = found;
    read_target(c, &found);
    for (int i = 0; i < SIZE_PX * SIZE_PX; i++) {
        wet += fabs(due.texels[i][0] - dry_one->texels[i][0]) > 0.02;
        doubtful += due.is_doubtful[i];
        for (int k = 0; k < 3 && !due.is_doubtful[i]; k++)
            if (fabs(found.texels[i][k] - due.texels[i][k]) > 0.012)
                fail_msg("%s: pixel (%d, %d), channel %d: %.4f, not %.4f; without rain %.4f",
                         settings, i % SIZE_PX, i / SIZE_PX, k, found.texels[i][k],
                         due.texels[i][k], dry_one->texels[i][k]);
    }
    if (wet < least_wet || doubtful > wet / 4)
        fail_msg("%s: rain on %d pixels, of which %d are doubtful", settings, wet, doubtful);
    free(dry_one);
    rig_close(c);
    rig_close(without);
}

static void sprites_are_painted_as_an_oracle_paints_them(void **state)
{
    (void)state;
    expect_picture("scene=house2 drops_s=150 drop_m=1.2 splash_m=0.1", 1.2, 0.1, 80, 300);
    expect_picture("scene=house2 drops_s=150 drop_m=0.1 splash_m=1.5 splash_s=0.6", 0.1, 1.5, 90,
                   300);
    expect_picture(
        "scene=car drops_s=300 drop_m=0.8 splash_m=0.9 wind_m_s=9 wind_turn_deg=30 cut=off", 0.8,
        0.9, 90, 500);
    expect_picture("scene=house1 drops_s=200 drop_m=0.7 splash_m=1.0 rise_deg=30 spin_deg=1", 0.7,
                   1.0, 100, 500);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sprites_are_painted_as_an_oracle_paints_them),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
