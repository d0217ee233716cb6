// Pictures of streaks against an oracle that draws them pixel by pixel in double precision: oracle
// DEVICE. Where drops are is read back (tests/core/techniques/streaks/particles.c holds that); all
// else, from the camera to the light that reaches the eye, is the oracle's.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/oracle/streaks/picture.h"

static const double pi = 3.14159265358979323846;

static char path[64];
static struct streak_atlas atlas;
static int first_level;

// --- the atlas ---

static uint16_t *texels[2][STREAK_OSCILLATIONS][STREAK_LEVELS];

static const uint16_t *read_level(struct rg_image *image, int which, int layer, int level)
{
    const int own = level - first_level;
    const size_t count = (size_t)(image->desc.width >> own) * (size_t)(image->desc.height >> own);
    uint16_t *to = texels[which][layer][level] = malloc(2 * count);
    assert_non_null(to);
    assert_true(rg_image_read(image, layer, own, to));
    return to;
}

// The pictures as they are on the device, the ends of each joined, and the factors.
static void take_atlas(void)
{
    struct streaks *s = rain_open("");
    const struct streaks_textures *t = s->textures;
    float factors[STREAK_OSCILLATIONS * STREAK_VIEWS * (STREAK_HEIGHTS * STREAK_AZIMUTHS + 1)];
    assert_true(rg_buf_read(t->factors, 0, factors, sizeof(factors)));
    const float *next = factors;
    first_level = t->first_level;
    for (int i = 0; i < STREAK_OSCILLATIONS; i++) {
        for (int level = first_level; level < STREAK_LEVELS; level++) {
            atlas.points[i][level] = read_level(t->points, 0, i, level);
            atlas.skies[i][level] = read_level(t->skies, 1, i, level);
        }
        for (int k = 0; k < STREAK_VIEWS * STREAK_HEIGHTS * STREAK_AZIMUTHS; k++)
            (&atlas.point_factors[i][0][0][0])[k] = (double)*next++;
    }
    for (int k = 0; k < STREAK_OSCILLATIONS * STREAK_VIEWS; k++)
        (&atlas.sky_factors[0][0])[k] = (double)*next++;
    rain_close(s);
}

static void free_atlas(void)
{
    for (int i = 0; i < 2 * STREAK_OSCILLATIONS * STREAK_LEVELS; i++)
        free((&texels[0][0][0])[i]);
}

// --- lights ---

enum { LAMP = 1, SPOT = 2, SUN = 4, SKY = 8, ALL = LAMP | SPOT | SUN | SKY };

// A lamp among the drops to the left, a spot from the right that holds a part of them, a sun from
// behind on the right.
static const struct streak_light lights[] = {
    {STREAK_LAMP, {1.5, 6, -1}, {0, 0, 0}, {30, 20, 10}, 0, 0},
    {STREAK_SPOT, {-3, 15, -14}, {2 / 7.0, -3 / 7.0, 6 / 7.0}, {200, 300, 400}, 8, 45},
    {STREAK_SUN, {0, 0, 0}, {0.48, -0.6, -0.64}, {1, 2, 1.5}, 0, 0},
};

static int write_lights(int kinds, struct streak_light *written)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "{\"lights\": [");
    int count = 0;
    for (int i = 0; i < 3; i++) {
        const struct streak_light *l = &lights[i];
        if (!(kinds & 1 << i))
            continue;
        static const char *const types[] = {"point", "spot", "sun"};
        fprintf(file, "%s{\"type\": \"%s\"", count ? ", " : "", types[i]);
        if (i != 2)
            fprintf(file, ", \"position_m\": [%g, %g, %g]", l->at[0], l->at[1], l->at[2]);
        if (i)
            fprintf(file, ", \"direction\": [%.12g, %.12g, %.12g]", l->direction[0],
                    l->direction[1], l->direction[2]);
        if (i == 1)
            fprintf(file, ", \"inner_deg\": %g, \"outer_deg\": %g", l->inner_deg, l->outer_deg);
        fprintf(file, ", \"colour\": [%g, %g, %g], \"shadows\": false}", l->colour[0], l->colour[1],
                l->colour[2]);
        written[count++] = *l;
    }
    fprintf(file, "]}\n");
    assert_int_equal(fclose(file), 0);
    return count;
}

// --- the view and the drops ---

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static void make_unit(double a[3])
{
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

// Upright in the picture is the world's y; who looks along z has x on the left.
static void look(struct streak_view *view, const struct streaks_settings *set)
{
    const double eye[3] = {set->eye_x_m, set->eye_y_m, set->eye_z_m};
    const double target[3] = {set->target_x_m, set->target_y_m, set->target_z_m};
    for (int i = 0; i < 3; i++) {
        view->eye[i] = eye[i];
        view->ahead[i] = target[i] - eye[i];
    }
    make_unit(view->ahead);
    cross(view->ahead, (double[]){0, 1, 0}, view->right);
    make_unit(view->right);
    cross(view->right, view->ahead, view->above);
    view->width = RAIN_WIDTH;
    view->height = RAIN_HEIGHT;
    view->focal_px = RAIN_HEIGHT / 2.0 / tan(set->view_angle_deg / 2 * pi / 180);
}

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
        // Rayleigh's frequency of water.
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

// Draws rain with these lights, and adds up how far it is from the oracle's.
static void draw_both(int kinds, int taps, const char *settings, struct tally *tally)
{
    char all[800];
    struct streak_light shine[3];
    const int count = write_lights(kinds, shine);
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
    struct streak_view view = {.taps = taps,
                               .first_level = first_level,
                               .last_level = s->settings.last_mip,
                               .absolute = s->settings.absolute_views,
                               .gain = s->settings.streak_gain,
                               .opacity = s->settings.streak_opacity,
                               .lights = shine,
                               .light_count = count};
    for (int c = 0; c < 3; c++) {
        view.sky[c] = kinds & SKY ? c + 1 : 0;
        view.up[c] = -s->space.s[c];
    }
    look(&view, &s->settings);
    s->params.drops = 1;
    int drop_count;
    struct streak_drop *drops = drops_of(s, &drop_count);
    struct streak_pixel *due = pixels_of(dry);
    streak_picture_draw(&view, &atlas, drops, drop_count, due);
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
    if (!first_level)
        take_atlas();
    struct tally sum = {0};
    for (size_t i = 0; i < sizeof(views) / sizeof(views[0]); i++) {
        struct tally one = {0};
        draw_both(kinds, taps, views[i], &one);
        assert_true(one.pixels > 300);
        sum.pixels += one.pixels;
        sum.off += one.off;
        sum.stray += one.stray;
        sum.due += one.due;
        sum.is += one.is;
    }
    const double bias = sum.is / sum.due - 1;
    print_message("%s, %d taps: %d pixels, %d off, %d stray, bias %.4f %%\n", about, taps,
                  sum.pixels, sum.off, sum.stray, 100 * bias);
    assert_true(sum.off + sum.stray <= 0.001 * sum.pixels);
    assert_true(fabs(bias) <= 0.002);
}

static void test_sky(void **state)
{
    (void)state;
    // Whatever the textures a light.
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
    free_atlas();
    remove(path);
    return status;
}
