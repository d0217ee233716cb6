// Splashed water against an oracle: paths of light that are followed one by one, in double
// precision, through every surface that they meet. They share the water itself with the tracer, its
// balls, sheet and ring, and nothing of how light is followed.
#include <math.h>
#include <stdint.h>

#include "core/scene/atlas/splash.h"
#include "tests/oracle/optics/fresnel.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846, water_index = 1.333;
enum {
    WIDE = RG_SPLASH_WIDTH_PX,
    TALL = RG_SPLASH_HEIGHT_PX,
    TRIES = 2048,
    FEWER = 128, // where the tracer sees no water
    EVENTS = 64,
    FIELDS = 3,
    SIDE = 4, // of a block of texels
    BLOCKS = WIDE / SIDE * (TALL / SIDE)
};

static uint64_t seed;

static double chance(void)
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) / 9007199254740992.0;
}

struct path {
    double at[3], way[3];
    int inside; // the ball that it is in, or -1
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// --- what a path meets first ---

static double meet_ball(const struct rg_water_ball *ball, const struct path *path, bool leaves)
{
    double off[3];
    for (int i = 0; i < 3; i++)
        off[i] = path->at[i] - ball->at[i];
    const double b = dot(off, path->way), c = dot(off, off) - ball->radius_m * ball->radius_m;
    if (b * b < c)
        return INFINITY;
    const double far = leaves ? -b + sqrt(b * b - c) : -b - sqrt(b * b - c);
    return far > 1e-9 ? far : INFINITY;
}

// The sheet's edge at an angle, and whether a place of the cone is below it.
static bool is_on_sheet(const struct rg_water *w, const double at[3])
{
    const double angle = atan2(at[2], at[0]);
    return at[1] >= 0 && at[1] <= w->height_m * (0.87 + 0.13 * cos(w->spikes * angle + w->turn));
}

// Steps along the path until the cone is crossed, and halves the step that crossed it. The cone is
// in a ball about the impact.
static double meet_sheet(const struct rg_water *w, const struct path *path, double end)
{
    const double step = 5e-4, reach = w->foot_m + w->flare * w->height_m + w->height_m;
    const double nearest = -dot(path->at, path->way);
    const double half2 = reach * reach - dot(path->at, path->at) + nearest * nearest;
    double last = 0;
    for (double far = fmax(1e-7, nearest - sqrt(fmax(half2, 0)) - step);
         half2 > 0 && far < end && far < nearest + sqrt(half2) + step; far += step) {
        double low = far - step, high = far, at[3];
        for (int i = 0; i < 3; i++)
            at[i] = path->at[i] + far * path->way[i];
        const double off = hypot(at[0], at[2]) - w->foot_m - w->flare * at[1];
        const bool crossed = last * off < 0;
        last = off;
        for (int halving = 0; crossed && halving < 40; halving++) {
            const double middle = 0.5 * (low + high);
            for (int i = 0; i < 3; i++)
                at[i] = path->at[i] + middle * path->way[i];
            const double here = hypot(at[0], at[2]) - w->foot_m - w->flare * at[1];
            *(here * off > 0 ? &high : &low) = middle;
        }
        if (crossed && low > 1e-7 && is_on_sheet(w, at))
            return low;
    }
    return INFINITY;
}

// --- what happens there ---

static void mirror(struct path *path, const double normal[3])
{
    const double into = dot(path->way, normal);
    for (int i = 0; i < 3; i++)
        path->way[i] -= 2 * into * normal[i];
}

static void cross_ball(const struct rg_water *w, int ball, struct path *path)
{
    const bool leaves = path->inside >= 0;
    double normal[3];
    for (int i = 0; i < 3; i++)
        normal[i] = (path->at[i] - w->balls[ball].at[i]) / w->balls[ball].radius_m;
    const double from = leaves ? water_index : 1, to = leaves ? 1 : water_index;
    const double cosine = fabs(dot(path->way, normal)), side = leaves ? 1 : -1;
    if (chance() < fresnel(acos(fmin(cosine, 1)), from / to)) {
        mirror(path, normal);
        return;
    }
    const double sine2 = (1 - cosine * cosine) * from * from / to / to;
    for (int i = 0; i < 3; i++)
        path->way[i] = from / to * (path->way[i] - side * cosine * normal[i]) +
                       side * sqrt(1 - sine2) * normal[i];
    path->inside = leaves ? -1 : ball;
}

static void cross_sheet(const struct rg_water *w, struct path *path)
{
    const double length = hypot(1, w->flare), radius = hypot(path->at[0], path->at[2]);
    const double normal[3] = {path->at[0] / radius / length, -w->flare / length,
                              path->at[2] / radius / length};
    const double one = fresnel(acos(fmin(fabs(dot(path->way, normal)), 1)), 1 / water_index);
    if (chance() < 2 * one / (1 + one))
        mirror(path, normal);
}

// A direction's field of the sky: overhead, beyond the splash, or on the viewer's side.
static int field_of(double height_deg, double azimuth_deg)
{
    return height_deg > 40 ? 0 : azimuth_deg > 100 ? 1 : 2;
}

// Follows a path to where it meets the ground, or for ever upwards. Returns whether it ends.
static bool follow(const struct rg_water *w, struct path *path)
{
    for (int event = 0; event < EVENTS; event++) {
        const double ground = path->way[1] < 0 ? -path->at[1] / path->way[1] : INFINITY;
        double nearest = ground;
        int ball = -1;
        for (int i = 0; i < w->count; i++) {
            if (path->inside >= 0 && i != path->inside)
                continue;
            const double far = meet_ball(&w->balls[i], path, path->inside >= 0);
            if (far < nearest) {
                nearest = far;
                ball = i;
            }
        }
        const double sheet =
            path->inside < 0 && w->height_m > 0 ? meet_sheet(w, path, nearest) : INFINITY;
        const double far = fmin(sheet, nearest);
        for (int i = 0; far < INFINITY && i < 3; i++)
            path->at[i] += far * path->way[i];
        if (sheet < nearest)
            cross_sheet(w, path);
        else if (ball >= 0)
            cross_ball(w, ball, path);
        else
            return true;
    }
    return false;
}

// What paths through a texel show.
struct seen {
    double fields[FIELDS]; // shares that end in each field of the sky
    double sky;            // all of them
    double traced;         // the same share, as the tracer has it for the same rays
    double moved;          // the share that ends on the ground, a pixel from the place behind
};

// A pixel at 10 m, in a picture of 540 rows with an angle of view of 50 degrees: 17 mm.
static const double pixel_m = 2 * 10 * 0.46631 / 540;

// The share of light from above the horizon that the tracer finds for one ray.
static double trace(const struct rg_water *w, const struct path *path, const double start[3])
{
    const struct rg_water_ball *nearest = NULL;
    struct rg_water_light light;
    double least = INFINITY, sum = 0;
    for (int i = 0; i < w->count; i++) {
        const double far = meet_ball(&w->balls[i], path, false);
        nearest = far < least ? &w->balls[i] : nearest;
        least = fmin(far, least);
    }
    rg_water_see(w, nearest, start, path->way, &light);
    for (int i = 0; i < light.count; i++)
        sum += light.from[i][1] > 0 ? light.share[i] : 0;
    return sum;
}

// Rays pass through a texel on a plane through the impact, which faces the viewer.
static void add_ray(const struct rg_water *w, int column, int row, double share, struct seen *seen)
{
    const double tilt = 15 * pi / 180, texel = 0.06 / WIDE;
    const double x = (column + chance() - WIDE / 2.0) * texel;
    const double up = (TALL - row - chance()) * texel - 0.008;
    const double start[3] = {x, up * cos(tilt), up * sin(tilt)};
    struct path path = {{x, start[1] + 0.1 * sin(tilt), start[2] - 0.1 * cos(tilt)},
                        {0, -sin(tilt), cos(tilt)},
                        -1};
    seen->traced += share * trace(w, &path, start);
    if (!follow(w, &path))
        return;
    if (path.way[1] < 0) {
        const double behind = start[2] + start[1] / tan(tilt);
        const double off = hypot(path.at[0] - x, (path.at[2] - behind) * sin(tilt));
        seen->moved += off > pixel_m ? share : 0;
        return;
    }
    const double azimuth = acos(-path.way[2] / hypot(path.way[0], path.way[2]));
    seen->fields[field_of(asin(path.way[1]) * 180 / pi, azimuth * 180 / pi)] += share;
    seen->sky += share;
}

static struct seen see_texel(const struct rg_water *w, int column, int row, int tries)
{
    struct seen seen = {0};
    for (int k = 0; k < tries; k++)
        add_ray(w, column, row, 1.0 / tries, &seen);
    return seen;
}

static void expect_fields(const struct rg_splash_light *light, const double due[FIELDS])
{
    double is[FIELDS] = {0}, sums[2] = {0};
    for (int height = 0; height < RG_ATLAS_LIGHTS; height++)
        for (int phi = 0; phi < RG_ATLAS_PHIS; phi++)
            is[field_of(20 * height - 90, 20 * phi + 10)] += light->cells[height][phi];
    for (int i = 0; i < FIELDS; i++) {
        sums[0] += is[i];
        sums[1] += due[i];
    }
    for (int i = 0; i < FIELDS; i++)
        if (fabs(is[i] / sums[0] - due[i] / sums[1]) > 0.02)
            fail_msg("field %d of the sky: %.3f of the light, not %.3f", i, is[i] / sums[0],
                     due[i] / sums[1]);
}

// How far apart the blocks of a picture are, over all of its light.
static double blocks_apart(const double blocks[BLOCKS][2])
{
    double apart = 0, all = 0;
    for (int i = 0; i < BLOCKS; i++) {
        apart += fabs(blocks[i][0] - blocks[i][1]);
        all += blocks[i][1];
    }
    return apart / all;
}

// The crowns are compared as a whole, texel by texel where the tracer sees water, and by where
// their light comes from. The tracer's 64 rays a texel leave the smallest droplets to chance: they
// are 12 to 23 % of the light apart in the mean, and miss up to 1.5 % of it elsewhere. With the
// rays of the paths themselves, blocks of 4 x 4 texels are 2 to 6 % of the light apart, of which
// 1 to 2 % are chance.
static void expect_crown(int material, double time_s)
{
    struct rg_water water;
    struct rg_splash_light light = {0};
    float texels[TALL * WIDE];
    rg_splash_water(RG_SWINGS_MEASURED, material, time_s, &water);
    water.ring_height_m = 0; // the wave has a test of its own
    assert_true(rg_splash_see(&water, texels, &light));
    double is = 0, due = 0, apart = 0, missed = 0, traced = 0, moved = 0, fields[FIELDS] = {0};
    double blocks[BLOCKS][2] = {0};
    int mask = 0;
    for (int i = 0; i < TALL * WIDE; i++) {
        const bool is_seen = texels[i] > 0;
        const struct seen seen = see_texel(&water, i % WIDE, i / WIDE, is_seen ? TRIES : FEWER);
        for (int k = 0; k < FIELDS; k++)
            fields[k] += seen.fields[k];
        *(is_seen ? &due : &missed) += seen.sky;
        if (!is_seen)
            continue;
        double *block = blocks[i / WIDE / SIDE * (WIDE / SIDE) + i % WIDE / SIDE];
        block[0] += seen.traced;
        block[1] += seen.sky;
        is += (double)texels[i];
        apart += fabs((double)texels[i] - seen.sky);
        traced += seen.traced;
        moved += seen.moved;
        mask++;
    }
    print_message("material %d, %.0f ms: %d balls, %d texels, %.4f of the sky's light, %.4f due, "
                  "%.1f %% apart in the mean, %.2f %% elsewhere; with the same rays %.4f, blocks "
                  "%.1f %% apart; %.1f %% from elsewhere on the ground\n",
                  material, 1000 * time_s, water.count, mask, is / mask, due / mask,
                  100 * apart / due, 100 * missed / due, traced / mask, 100 * blocks_apart(blocks),
                  100 * moved / mask);
    assert_at_least(mask, 60);
    assert_below(fabs(is / due - 1), 0.05);
    assert_below(apart, 0.26 * due);
    assert_below(fabs(traced / due - 1), 0.05);
    assert_below(blocks_apart(blocks), 0.06);
    assert_below(moved, 0.08 * mask); // what looking it up elsewhere would change, at most
    assert_below(missed, 0.02 * due);
    expect_fields(&light, fields);
}

// The height of a ring's wave, as if all of it were as far from the impact as `away`. It falls off
// with the root of that distance.
static double wave_height(const struct rg_water *w, double radius, double away)
{
    const double across = (radius - w->ring_m) / w->ring_width_m;
    return w->ring_height_m * (1 + cos(pi * across)) / sqrt(away / 0.01);
}

static double wave_slope(const struct rg_water *w, double away)
{
    const double step = 1e-7;
    return (wave_height(w, away + step, away) - wave_height(w, away - step, away)) / (2 * step);
}

// The side of a wave that is turned away, seen from 15 degrees above, mirrors as much more of the
// sky as Fresnel says, and nothing shows in a furnace that is not mirrored. The wave's slope is
// that of its height, without its falling off, which would be 5 % of the slope here.
static void test_waves(void **state)
{
    (void)state;
    const double tilt = 15 * pi / 180, way[3] = {0, -sin(tilt), cos(tilt)};
    // A place half way up the ring's outer side, behind the impact.
    const struct rg_water water = {.ring_m = 0.01, .ring_width_m = 0.004, .ring_height_m = 0.0001};
    const double away = 0.012, slope = wave_slope(&water, away);
    const double start[3] = {0, 0.1 * sin(tilt), away - 0.1 * cos(tilt)};
    const double flat = fresnel(pi / 2 - tilt, 1 / water_index);
    struct rg_water_light light;
    rg_water_see(&water, NULL, start, way, &light);
    assert_equals(light.count, 1);
    const double turned = atan(-slope),
                 due = fresnel(pi / 2 - tilt + turned, 1 / water_index) - flat;
    assert_below(fabs(light.share[0] / due - 1), 1e-6);
    assert_below(fabs(asin(light.from[0][1]) - (tilt - 2 * turned)), 1e-6);
    const double before[3] = {0, 0.1 * sin(tilt), -away - 0.1 * cos(tilt)};
    rg_water_see(&water, NULL, before, way, &light);
    assert_equals(light.count, 0); // it faces the viewer, and mirrors less than flat water
}

// An even sky shows with all its directions' parts: they make 1.
static void test_parts_make_a_sky(void **state)
{
    (void)state;
    struct rg_splash_light light = {0};
    float texels[TALL * WIDE], parts[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
    assert_true(rg_splash_draw(RG_SWINGS_MEASURED, 0, 2, texels, &light));
    rg_splash_parts(&light, parts);
    double sum = 0;
    for (int height = 0; height < RG_ATLAS_LIGHTS; height++) {
        const double low = fmax(20 * height - 100, -90), high = fmin(20 * height - 80, 90);
        for (int phi = 0; phi < RG_ATLAS_PHIS; phi++) {
            sum += (double)parts[height][phi] * 2 * pi / RG_ATLAS_PHIS *
                   (sin(high * pi / 180) - sin(low * pi / 180));
            assert_true(high > 0 || parts[height][phi] == 0);
        }
    }
    assert_below(fabs(sum - 1), 1e-6);
}

static void test_a_dark_splash_has_no_parts(void **state)
{
    (void)state;
    const struct rg_splash_light dark = {0};
    float parts[RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];
    rg_splash_parts(&dark, parts);
    for (int i = 0; i < RG_ATLAS_CELLS; i++)
        assert_equals((&parts[0][0])[i], 0);
}

static void test_crowns_are_as_bright_as_paths_find(void **state)
{
    (void)state;
    seed = 7;
    expect_crown(0, 0.015);
    expect_crown(0, 0.033);
    expect_crown(1, 0.021);
    expect_crown(2, 0.006);
    expect_crown(3, 0.009);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crowns_are_as_bright_as_paths_find),
        cmocka_unit_test(test_waves),
        cmocka_unit_test(test_parts_make_a_sky),
        cmocka_unit_test(test_a_dark_splash_has_no_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
