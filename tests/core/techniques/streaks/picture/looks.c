// The look of rain in cases that need no reference picture: looks DEVICE. A blank part of the atlas
// shows, by what is then missing, what was read. Suns shine from one side, and their light is
// compared with an oracle's through a drop at rest.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/oracle/optics/drop.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846;

// So much light that rounding down to halves loses nothing that matters.
enum { GAIN = 1000, SKY = 16 };

// Seen from the side, a pixel is at most 2 cm. Level 2 is the first of the small atlas, and the
// only one that is read.
static struct streaks *open_beside(const char *settings)
{
    char all[700];
    snprintf(all, sizeof(all),
             "state=on geometry=off time=night streak_opacity=0 splash_opacity=0 streak_gain=%d "
             "rain_width_m=30 rain_depth_m=30 rain_height_m=60 local_height_m=50 "
             "culling_radius_m=42 eye_z_m=-26 target_y_m=3 target_z_m=0 last_mip=2 %s",
             GAIN, settings);
    struct streaks *s = rain_open(all);
    rain_step(s, 2);
    return s;
}

// --- pictures ---

// The light that rain adds to the picture, in a colour of all lights and the sky.
struct added {
    double at[RAIN_HEIGHT][RAIN_WIDTH];
};

static struct added *added_by_rain(struct streaks *s)
{
    const streaks_params params = s->params;
    struct rain_texels *lit = rain_read(s);
    s->params.drops = s->params.splashes = 0;
    struct rain_texels *dry = rain_read(s);
    s->params = params;
    struct added *added = malloc(sizeof(*added));
    assert_non_null(added);
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            added->at[y][x] = rain_texel(lit, x, y, 1) - rain_texel(dry, x, y, 1);
    free(lit);
    free(dry);
    return added;
}

static double total(struct added *added)
{
    double sum = 0;
    for (int i = 0; i < RAIN_TEXELS; i++)
        sum += (&added->at[0][0])[i];
    free(added);
    return sum;
}

struct seen_at {
    double x, y, pixels_a_metre;
};

// False if a place is not in the picture.
static bool see(const struct streaks *s, double x, double y, double along, struct seen_at *at)
{
    const rg_corner c = m4_project(s->params.to_clip, v3_make((float)x, (float)y, (float)along));
    at->x = (double)(c.x / c.w + 1) / 2 * RAIN_WIDTH;
    at->y = (double)(c.y / c.w + 1) / 2 * RAIN_HEIGHT;
    at->pixels_a_metre = (double)(s->params.focal_px / c.w);
    return c.w > 0 && at->x >= 0 && at->x < RAIN_WIDTH && at->y >= 0 && at->y < RAIN_HEIGHT;
}

// --- atlases with blanks ---

// The first view has 1050 of an atlas' 3606 rows.
enum { LAYERS = 10 };
static const double half_a_swing = 1050 / 2.0 / 3606;

// An image's first levels, which are restored afterwards.
struct kept {
    struct rg_image *image;
    int levels;
    uint16_t *texels[84][6];
};

static size_t bytes_of(const struct rg_image *image, int level)
{
    return 2 * (size_t)(image->desc.width >> level) * (size_t)(image->desc.height >> level);
}

static struct kept keep(struct rg_image *image, int levels)
{
    struct kept kept = {.image = image, .levels = levels};
    assert_between(image->desc.layers, 1, 84);
    for (int layer = 0; layer < image->desc.layers; layer++)
        for (int level = 0; level < levels; level++) {
            kept.texels[layer][level] = malloc(bytes_of(image, level));
            assert_non_null(kept.texels[layer][level]);
            assert_true(rg_image_read(image, layer, level, kept.texels[layer][level]));
        }
    return kept;
}

// Makes a share of a layer's rows blank.
static void blank(const struct kept *kept, int layer, double share)
{
    for (int level = 0; level < kept->levels; level++) {
        const size_t bytes = bytes_of(kept->image, level);
        const int height = kept->image->desc.height >> level;
        uint16_t *texels = malloc(bytes);
        assert_non_null(texels);
        memcpy(texels, kept->texels[layer][level], bytes);
        memset(texels, 0, bytes / (size_t)height * (size_t)(height * share));
        assert_true(rg_image_write(kept->image, layer, level, texels));
        free(texels);
    }
}

static void put_back(struct kept *kept)
{
    for (int layer = 0; layer < kept->image->desc.layers; layer++)
        for (int level = 0; level < kept->levels; level++)
            assert_true(rg_image_write(kept->image, layer, level, kept->texels[layer][level]));
}

static void release(struct kept *kept)
{
    put_back(kept);
    for (int layer = 0; layer < kept->image->desc.layers; layer++)
        for (int level = 0; level < kept->levels; level++)
            free(kept->texels[layer][level]);
}

static void blank_all_but(const struct kept *kept, int layer)
{
    for (int other = 0; other < kept->image->desc.layers; other++)
        if (other != layer)
            blank(kept, other, 1);
}

// --- streaks ---

// Each drop has its own oscillation, and all are equally frequent.
static void test_oscillations_differ(void **state)
{
    (void)state;
    struct streaks *s = open_beside("lights=0 splashes=off view_angle_deg=30 drops_m2_s=60");
    s->params.sky_g = SKY;
    const double whole = total(added_by_rain(s));
    struct kept kept = keep(s->textures->skies, 1);
    for (int layer = 0; layer < LAYERS; layer++) {
        blank_all_but(&kept, layer);
        const double share = total(added_by_rain(s)) / whole;
        put_back(&kept);
        assert_above(share, 0.07);
        assert_below(share, 0.13);
    }
    release(&kept);
    rain_close(s);
}

// A row of the atlas holds one whole swing, from top to bottom. With its first half blank, drops
// are seen only in the second half of their swings, at known heights. A drop has some phase at the
// end of the exposure, and was `cycles` before that at its beginning. Drops swing `faster` times as
// fast as those of the settings, as other sizes do.
static void expect_swings(const char *settings, double cycles, float faster)
{
    char all[256];
    snprintf(all, sizeof(all),
             "lights=0 splashes=off view_angle_deg=4 drops_m2_s=2 fall_speed_m_s=8 %s", settings);
    struct streaks *s = open_beside(all);
    s->sizes.words[2] = faster;
    rain_step(s, 1);
    s->params.sky_g = SKY;
    struct added *whole = added_by_rain(s);
    struct kept kept = keep(s->textures->skies, 1);
    for (int layer = 0; layer < LAYERS; layer++)
        blank(&kept, layer, half_a_swing);
    struct added *part = added_by_rain(s);
    release(&kept);
    const struct rain_places places = rain_read_places(s);
    int bright = 0, dark = 0, wrong = 0;
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        for (int k = 5; k < 95 && (int)place[5] == STREAKS_DROP; k++) {
            const double back = k / 100.0, at = (double)place[2] - back * (double)s->params.fall;
            const double turn = (double)place[7] - cycles * back, swing = turn - floor(turn);
            struct seen_at seen;
            if (at > (double)place[3] || !see(s, (double)place[0], (double)place[1], at, &seen) ||
                fabs(fabs(swing - 0.5) - 0.25) > 0.15)
                continue;
            const double was = whole->at[(int)seen.y][(int)seen.x],
                         is = part->at[(int)seen.y][(int)seen.x];
            if (!(was > 0))
                continue;
            bright += swing > 0.5;
            dark += swing < 0.5;
            wrong += (is > 0.5 * was) != (swing > 0.5);
        }
    }
    if (!(bright > 200 && dark > 200 && wrong < 0.03 * (bright + dark)))
        fail_msg("%s: of %d bright and %d dark places %d are wrong", settings, bright, dark, wrong);
    free(whole);
    free(part);
    free(places.words);
    rain_close(s);
}

// Rayleigh's frequency for water of 0.0728 N/m.
static double frequency(double radius_m)
{
    return sqrt(8 * 0.0728 / (1000 * pow(radius_m, 3))) / (2 * pi);
}

static void test_drops_swing_as_they_fall(void **state)
{
    (void)state;
    expect_swings("drop_radius_mm=4 exposure_s=0.1", frequency(0.004) * 0.1, 1);
    expect_swings("drop_radius_mm=2.5 exposure_s=0.05", frequency(0.0025) * 0.05, 1);
    expect_swings("drop_radius_mm=4 exposure_s=0.1", frequency(0.004) * 0.1 * 1.5, 1.5f);
}

// Drops at half the settings' speed make streaks half as long.
static void test_streaks_are_as_long_as_drops_fall(void **state)
{
    (void)state;
    struct streaks *s = open_beside("lights=0 splashes=off view_angle_deg=4 drops_m2_s=4 "
                                    "exposure_s=0.05");
    s->sizes.words[1] = 0.5f;
    rain_step(s, 1);
    s->params.sky_g = SKY;
    struct added *added = added_by_rain(s);
    const struct rain_places places = rain_read_places(s);
    int within = 0, lit = 0, beyond = 0, stray = 0;
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        for (int k = 5; k < 95 && (int)place[5] == STREAKS_DROP; k += 5) {
            const double at = (double)place[2] - k / 100.0 * (double)s->params.fall;
            struct seen_at seen;
            if (at > (double)place[3] || (k > 40 && k < 60) ||
                !see(s, (double)place[0], (double)place[1], at, &seen))
                continue;
            const bool is_lit = added->at[(int)seen.y][(int)seen.x] > 0;
            within += k < 50;
            lit += k < 50 && is_lit;
            beyond += k > 50;
            stray += k > 50 && is_lit;
        }
    }
    // Some are behind the ends of others, or too faint for a half.
    print_message("%d of %d within, %d of %d beyond\n", lit, within, stray, beyond);
    assert_above(within, 100);
    assert_above(beyond, 100);
    assert_above(lit, 0.8 * within);
    assert_below(stray, 0.1 * beyond);
    free(added);
    free(places.words);
    rain_close(s);
}

// --- lights ---

static char path[64];

// A sun at an elevation and an azimuth, counted from the viewer's to the right.
static void write_sun(double elevation, double azimuth, bool shadows)
{
    const double level = cos(elevation * pi / 180), turned = azimuth * pi / 180;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    // The viewer looks along z, so that -x is on the right.
    fprintf(file,
            "{\"lights\": [{\"type\": \"sun\", \"direction\": [%.9g, %.9g, %.9g], "
            "\"colour\": [1, 1, 1], \"intensity\": 16, \"shadows\": %s}]}\n",
            level * sin(turned), -sin(elevation * pi / 180), level * cos(turned),
            shadows ? "true" : "false");
    assert_int_equal(fclose(file), 0);
}

// A drop at rest under a light of irradiance 1, seen from elevation 0. Its mean radiance, and the
// distance of its light from the middle to the right, in radii.
struct glow {
    double radiance, aside;
};

static struct glow glow_of(bool database, double elevation, double azimuth)
{
    enum { RAYS = 128 };
    const struct oracle_drop rest = oracle_drop_at(database, 0, 0);
    const double level = cos(elevation * pi / 180), edge = cos(7.5 * pi / 180),
                 to[3] = {level * sin(azimuth * pi / 180), sin(elevation * pi / 180),
                          level * cos(azimuth * pi / 180)};
    double sum = 0, moment = 0;
    int hits = 0;
    for (int i = 0; i < RAYS * RAYS; i++) {
        const double u = 2 * (i % RAYS + 0.5) / RAYS - 1, v = 2 * (i / RAYS + 0.5) / RAYS - 1;
        double direction[ORACLE_WAYS][3], share[ORACLE_WAYS];
        if (!oracle_drop_light(&rest, (double[]){u, v, 4}, (double[]){0, 0, -1}, direction, share))
            continue;
        hits++;
        for (int way = 0; way < ORACLE_WAYS; way++) {
            const double *d = direction[way];
            const double cosine = d[0] * to[0] + d[1] * to[1] + d[2] * to[2];
            const double light = cosine > edge ? share[way] / (2 * pi * (1 - edge)) : 0;
            sum += light;
            moment += light * u;
        }
    }
    return (struct glow){sum / hits, moment / sum};
}

// A sun's added light, and the middle of that light, in pixels.
struct lit {
    double light, middle;
};

static struct lit lit_by(double elevation, double azimuth, const char *view, double *radius_px)
{
    char settings[320];
    write_sun(elevation, azimuth, false);
    snprintf(
        settings, sizeof(settings),
        "environment_light=off splashes=off view_angle_deg=1 drop_radius_mm=10 "
        "drops_m2_s=1000 rain_width_m=4 local_height_m=8 culling_radius_m=30 %s lights_file=%s",
        view, path);
    struct streaks *s = open_beside(settings);
    *radius_px = 0.010 * (double)s->params.focal_px / 26;
    struct kept kept = keep(s->textures->points, 1);
    blank_all_but(&kept, 0);
    struct added *added = added_by_rain(s);
    release(&kept);
    rain_close(s);
    struct lit lit = {0, 0};
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++) {
            lit.light += added->at[y][x];
            lit.middle += added->at[y][x] * (x + 0.5);
        }
    lit.middle /= lit.light;
    free(added);
    return lit;
}

// The oracle's rays are few for lamps of 7.5 degrees, its drop does not swing, and the atlas
// blends: the sides differ by 4.1 %, brightness by 7.2 %, and the middle by 0.26 radii of the
// database's drops and 0.13 of measured ones. Light from behind is a hundred times light from
// beside. Both are off the middle by at least half a radius.
static void expect_sides(bool database)
{
    static const double suns[][2] = {{10, 90}, {10, 150}, {-30, 130}, {50, 50}};
    struct lit first;
    struct glow of_first;
    for (size_t i = 0; i < sizeof(suns) / sizeof(suns[0]); i++) {
        double radius_px;
        const char *swings = database ? "swings=database" : "swings=measured";
        const struct lit right = lit_by(suns[i][0], suns[i][1], swings, &radius_px),
                         left = lit_by(suns[i][0], -suns[i][1], swings, &radius_px);
        const struct glow due = glow_of(database, suns[i][0], suns[i][1]);
        if (i == 0) {
            first = right;
            of_first = due;
        }
        const double brighter = right.light / first.light / (due.radiance / of_first.radiance),
                     aside = (right.middle - left.middle) / 2 / radius_px;
        print_message("%s, sun at %g, %g: the left is %.3f of the right, %.3f as bright as due, at "
                      "%.3f radii for %.3f\n",
                      swings, suns[i][0], suns[i][1], left.light / right.light, brighter, aside,
                      due.aside);
        if (!(fabs(left.light / right.light - 1) < 0.05 && fabs(brighter - 1) < 0.08 &&
              fabs(aside - due.aside) < (database ? 0.3 : 0.15)))
            fail_msg("sun at %g, %g: the left is %.2f of the right, %.2f as bright as due, at %.2f "
                     "radii for %.2f",
                     suns[i][0], suns[i][1], left.light / right.light, brighter, aside, due.aside);
    }
}

static void test_light_has_a_side(void **state)
{
    (void)state;
    expect_sides(false);
    expect_sides(true);
}

// Light goes ahead through drops: looking up, one sees a sun above and behind them; looking down,
// one below.
static void test_light_goes_by_the_view(void **state)
{
    (void)state;
    static const char *const views[] = {"target_y_m=25 local_height_m=60 drops_m2_s=200",
                                        "eye_y_m=28 target_y_m=6 local_height_m=60 drops_m2_s=200"};
    double radius_px;
    for (int i = 0; i < 2; i++) {
        const double above = lit_by(40, 170, views[i], &radius_px).light,
                     below = lit_by(-40, 170, views[i], &radius_px).light;
        assert_above(above, 0);
        assert_above(below, 0);
        assert_true(i ? below > 10 * above : above > 10 * below);
    }
}

// A shadow map with everything near the sun darkens the rain; one with everything far away leaves
// it as without shadows.
static void expect_shadows(const char *what)
{
    double light[3];
    for (int i = 0; i < 3; i++) {
        char settings[256];
        write_sun(50, 30, i < 2);
        snprintf(settings, sizeof(settings),
                 "environment_light=off view_angle_deg=12 target_y_m=0 drops_m2_s=20 "
                 "splash_gain=1000 splash_width_mm=600 lights_file=%s %s",
                 path, what);
        struct streaks *s = open_beside(settings);
        const float depth = (float)i;
        if (i < 2)
            assert_true(rg_image_clear(s->lights->shadows, &depth));
        light[i] = total(added_by_rain(s));
        rain_close(s);
    }
    assert_above(light[2], 1);
    assert_equals(light[0], 0);
    assert_equals(light[1], light[2]);
}

static void test_shadows_fall_on_rain(void **state)
{
    (void)state;
    expect_shadows("splashes=off");
    expect_shadows("drops=off");
}

// --- splashes ---

// The later half of all frames is blank: young splashes are seen, and old ones are not.
static void test_splashes_go_forwards(void **state)
{
    (void)state;
    struct streaks *s =
        open_beside("drops=off lights=0 view_angle_deg=12 target_y_m=0 drops_m2_s=1 "
                    "splash_gain=1000 splash_s=0.5 splash_width_mm=600");
    s->params.sky_g = SKY;
    struct kept kept = keep(s->textures->crowns, 6);
    for (int layer = 0; layer < kept.image->desc.layers; layer++)
        if (layer % 21 >= 10)
            blank(&kept, layer, 1);
    struct added *added = added_by_rain(s);
    release(&kept);
    const struct rain_places places = rain_read_places(s);
    int young = 0, young_seen = 0, old = 0, old_seen = 0;
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        const double share = (double)place[4] / 0.5;
        struct seen_at at;
        if ((int)place[5] != STREAKS_SPLASH ||
            !see(s, (double)place[0], (double)place[1], (double)place[3] - 0.1, &at))
            continue;
        double most = 0;
        for (int x = (int)at.x - 2; x <= (int)at.x + 2; x++)
            most = fmax(most, x >= 0 && x < RAIN_WIDTH ? added->at[(int)at.y][x] : 0);
        young += share > 0.1 && share < 0.35;
        young_seen += share > 0.1 && share < 0.35 && most > 0;
        old += share > 0.6;
        old_seen += share > 0.6 && most > 0;
    }
    // Some old splashes are behind younger ones.
    assert_above(young, 10);
    assert_above(old, 10);
    assert_above(young_seen, 0.9 * young);
    assert_below(old_seen, 0.5 * old);
    free(added);
    free(places.words);
    rain_close(s);
}

int main(int argc, char **argv)
{
    snprintf(path, sizeof(path), "test_looks_%ld.json", (long)getpid());
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_oscillations_differ),
        cmocka_unit_test(test_drops_swing_as_they_fall),
        cmocka_unit_test(test_streaks_are_as_long_as_drops_fall),
        cmocka_unit_test(test_light_has_a_side),
        cmocka_unit_test(test_shadows_fall_on_rain),
        cmocka_unit_test(test_light_goes_by_the_view),
        cmocka_unit_test(test_splashes_go_forwards),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    remove(path);
    return status;
}
