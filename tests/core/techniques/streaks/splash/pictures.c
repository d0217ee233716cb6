// Pictures of splashes against an oracle, one pixel at a time: pictures DEVICE. With an opacity of
// 0 splashes only add light, and with a gain of 0 they only hide. In both cases their order does
// not matter.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/scene/atlas/levels.h"
#include "core/scene/atlas/splash.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/core/techniques/streaks/splash/crown.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/sanitized.h"

enum { MATERIALS = 4 };

static char mesh[64], lights[64];

// --- the animation, as it is synthesised ---

static struct crown_film films[MATERIALS];

static float parts[MATERIALS][RG_ATLAS_LIGHTS][RG_ATLAS_PHIS];

static void make_films(void)
{
    for (int m = 0; m < MATERIALS; m++) {
        struct rg_splash_light light = {0};
        for (int f = 0; f < CROWN_FRAMES; f++) {
            float texels[CROWN_TALL * CROWN_WIDE];
            assert_true(rg_splash_draw(RG_SWINGS_MEASURED, m, f, texels, &light));
            for (int i = 0; i < CROWN_TALL * CROWN_WIDE; i++)
                films[m].texels[f][0][i] = (double)rg_half_value(rg_half_of(texels[i]));
            crown_halve(&films[m], f);
        }
        rg_splash_parts(&light, parts[m]);
    }
}

// --- light ---

struct lamp {
    const char *type; // sky, point, spot or sun
    double at[3], travels[3], inner_deg, outer_deg;
};

static const double colour[3] = {1, 0.6, 0.25};

// The lamp hangs so low that splashes reach above it, where it does not light them.
static const struct lamp lamps[] = {
    {.type = "sky"},
    {"point", {3, 114.9, 1}, {0, -1, 0}, 0, 0},
    {"spot", {-2, 121, 2}, {0.4243, -0.8485, -0.3162}, 12, 32},
    {"sun", {0, 0, 0}, {0.36, -0.8, -0.48}, 0, 0},
};
enum { LAMPS = sizeof(lamps) / sizeof(lamps[0]) };

static bool is_of(const struct lamp *lamp, const char *type)
{
    return strcmp(lamp->type, type) == 0;
}

static void write_lights(const struct lamp *lamp)
{
    FILE *file = fopen(lights, "w");
    assert_non_null(file);
    const bool sky = is_of(lamp, "sky");
    fprintf(file, "{\"lights\": [{\"type\": \"%s\", ", sky ? "sun" : lamp->type);
    if (is_of(lamp, "point") || is_of(lamp, "spot"))
        fprintf(file, "\"position_m\": [%.9g, %.9g, %.9g], ", lamp->at[0], lamp->at[1],
                lamp->at[2]);
    if (!is_of(lamp, "point"))
        fprintf(file, "\"direction\": [%.9g, %.9g, %.9g], ", lamp->travels[0],
                sky ? -1 : lamp->travels[1], lamp->travels[2]);
    if (is_of(lamp, "spot"))
        fprintf(file, "\"inner_deg\": %.9g, \"outer_deg\": %.9g, ", lamp->inner_deg,
                lamp->outer_deg);
    const double lit = sky ? 0 : is_of(lamp, "sun") ? 1 : 20, shone = sky ? 1 : 0;
    fprintf(file, "\"colour\": [%.9g, %.9g, %.9g], \"shadows\": false}], ", lit * colour[0],
            lit * colour[1], lit * colour[2]);
    fprintf(file, "\"sky\": {\"colour\": [%.9g, %.9g, %.9g]}}\n", shone * colour[0],
            shone * colour[1], shone * colour[2]);
    assert_int_equal(fclose(file), 0);
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The share of a lamp's colour that reaches a place, and the direction to the lamp.
static double reach_of(const struct lamp *lamp, const double at[3], double towards[3])
{
    double squared = 0;
    for (int i = 0; i < 3; i++) {
        towards[i] = is_of(lamp, "sun") ? -lamp->travels[i] : lamp->at[i] - at[i];
        squared += towards[i] * towards[i];
    }
    for (int i = 0; i < 3; i++)
        towards[i] /= sqrt(squared);
    const double full = is_of(lamp, "sun") ? 1 : 20 / fmax(squared, 0.01);
    if (!is_of(lamp, "spot"))
        return full;
    const double cosine = -dot(towards, lamp->travels);
    const double inner = cos(lamp->inner_deg * acos(-1) / 180);
    const double outer = cos(lamp->outer_deg * acos(-1) / 180);
    const double in = fmin(fmax((cosine - outer) / (inner - outer), 0), 1);
    return full * in * in * (3 - 2 * in);
}

// The radiance of a splash whose texel is 1: of a white matt surface by Lambert's law, or of clear
// water, by the atlas' direction that is nearest to the light's at the picture's middle.
static double light_at(const struct crown_eye *eye, const struct lamp *lamp,
                       const struct crown_pixel *pixel, const struct crown_splash *splash,
                       bool matt)
{
    double towards[3], middle[3], ray[3];
    if (is_of(lamp, "sky"))
        return 1;
    const double reach = reach_of(lamp, pixel->at, towards);
    if (matt)
        return reach * fmax(dot(towards, splash->up), 0);
    reach_of(lamp, pixel->middle, middle);
    for (int i = 0; i < 3; i++)
        ray[i] = pixel->middle[i] - eye->at[i];
    const double aside = middle[0] * ray[2] - middle[2] * ray[0];
    const double before = -(middle[0] * ray[0] + middle[2] * ray[2]), step = acos(-1) / 9;
    const double phi = atan2(fabs(aside), before) / step - 0.5;
    const double height = asin(fmin(fmax(middle[1], -1), 1)) / step + 4.5;
    const int row = (int)floor(fmin(fmax(height, 0), 9) + 0.5);
    const int column = (int)floor(fmin(fmax(phi, 0), 8) + 0.5);
    const double part = (double)parts[splash->film - films][row][column];
    return acos(-1) * part * reach;
}

// --- scenes ---

// A plane that rises towards -z, as wide as the small city. Ten bits a component hold its normal
// exactly. A fence on it hides things behind.
static double slope[3] = {0, 55 / 73.0, 48 / 73.0};
static const double on_slope[3] = {0, 115, 0};
// The file's unit in metres: the scene is scaled to the city's height.
static double unit_m = 115 * 55 / 48.0;
static const double fence_x[2] = {-0.03, 0.004}, fence_z = 0.004, fence_m = 2;

static void write_mesh(bool fenced)
{
    const double tangent = slope[2] / slope[1], low = tangent * (1 - fence_z),
                 high = low + fence_m / unit_m;
    FILE *file = fopen(mesh, "w");
    assert_non_null(file);
    fprintf(file, "OFF\n%d %d 0\n", fenced ? 8 : 4, fenced ? 4 : 2);
    fprintf(file, "-1 0 1\n1 0 1\n1 %.12f -1\n-1 %.12f -1\n", 2 * tangent, 2 * tangent);
    if (fenced)
        for (int k = 0; k < 4; k++)
            fprintf(file, "%.9f %.12f %.9f\n", fence_x[k == 1 || k == 2], k < 2 ? low : high,
                    fence_z);
    fprintf(file, "3 0 1 2\n3 0 2 3\n%s", fenced ? "3 4 5 6\n3 4 6 7\n" : "");
    assert_int_equal(fclose(file), 0);
}

static bool is_cut(const struct crown_eye *eye, const struct crown_pixel *pixel)
{
    static const double away[3] = {0, 0, 1};
    const double fence[3] = {0, 0, unit_m * fence_z};
    if (crown_hidden(eye, pixel, on_slope, slope))
        return true;
    // The place where the ray crosses the fence's plane.
    const double met = (fence[2] - eye->at[2]) / (pixel->at[2] - eye->at[2]);
    const double x = eye->at[0] + met * (pixel->at[0] - eye->at[0]);
    const double y = eye->at[1] + met * (pixel->at[1] - eye->at[1]);
    const double foot = on_slope[1] - fence[2] * slope[2] / slope[1];
    return crown_hidden(eye, pixel, fence, away) && x > unit_m * fence_x[0] &&
           x < unit_m * fence_x[1] && y < foot + fence_m;
}

#define EYE(eye, target) "eye_x_m=" eye " target_x_m=0 target_y_m=" target " target_z_m=0 "
#define ALONG_SLOPE                                                                                \
    {                                                                                              \
        0, 55 / 73.0, 48 / 73.0                                                                    \
    }

static const struct view {
    const char *name, *settings;
    double normal[3];
    bool cut;
} views[] = {
    {"from above", "geometry=off " EYE("6 eye_y_m=123 eye_z_m=7", "115.5"), ALONG_SLOPE, false},
    {"upright, from the side",
     "splash_up=vertical geometry=off " EYE("-9 eye_y_m=116.5 eye_z_m=4", "115.5"),
     {0, 1, 0},
     false},
    {"from below", "geometry=off " EYE("-4 eye_y_m=109 eye_z_m=5", "115.5"), ALONG_SLOPE, false},
    {"cut off", EYE("-1 eye_y_m=117 eye_z_m=10", "115.6"), ALONG_SLOPE, true},
};
enum { VIEWS = sizeof(views) / sizeof(views[0]) };

#define SETTINGS                                                                                   \
    "scene=%s lights_file=%s rain_height_m=400 local_height_m=40 depth_map_px=2048 state=on "      \
    "drops=off splash_width_mm=%d drops_m2_s=%g view_angle_deg=30 packets=world blocks=all "       \
    "splash_gain=%g splash_opacity=%g time=%s culling_radius_m=30 %s"

// --- expected pictures ---

struct due {
    double light[RAIN_TEXELS], left[RAIN_TEXELS], peak[RAIN_TEXELS], most_hidden;
    int layers[RAIN_TEXELS], splashes, cut;
};

// The inputs of a picture.
struct asked {
    const struct view *view;
    const struct lamp *lamp;
    double opacity;
    bool matt;
};

static struct crown_eye eye_of(const struct streaks *s)
{
    struct crown_eye eye = {
        .focal_px = (double)s->observer.focal_px, .width = RAIN_WIDTH, .height = RAIN_HEIGHT};
    for (int i = 0; i < 16; i++)
        eye.clip[i] = (double)s->observer.world_to_clip[i];
    const double at[3] = {(double)s->settings.eye_x_m, (double)s->settings.eye_y_m,
                          (double)s->settings.eye_z_m};
    memcpy(eye.at, at, sizeof(at));
    return eye;
}

static struct crown_splash splash_of(const struct streaks *s, const struct view *view,
                                     const float *place, int64_t i)
{
    const double rain[3] = {(double)place[0], (double)place[1], (double)place[3]};
    const int64_t block = i / STREAKS_BLOCK * STREAKS_BLOCK_WORDS;
    struct crown_splash splash = {
        .film = &films[(int)place[6]],
        .wide = s->settings.splash_width_mm / 1000,
        .lasts_s = s->settings.splash_s,
        .age_s = (double)place[4],
        .drops = (double)place[9],
        .size = (double)place[8] / (s->settings.drop_radius_mm / 1000),
        .number = s->selection.blocks[block] + (uint32_t)(i % STREAKS_BLOCK),
    };
    rg_rain_world_point(&s->space, rain, splash.foot);
    memcpy(splash.up, view->normal, sizeof(splash.up));
    // On the plane itself, since the map of heights has one height a texel.
    const double from[3] = {splash.foot[0] - on_slope[0], 0, splash.foot[2] - on_slope[2]};
    if (view->normal[2] > 0)
        splash.foot[1] = on_slope[1] - dot(from, slope) / slope[1];
    return splash;
}

// A splash's light at a pixel. A splash that is cut off there would have had `full`.
struct glow {
    double full;
    bool is_there, is_cut;
};

static struct glow glow_at(struct due *due, const struct crown_eye *eye,
                           const struct crown_splash *splash, const struct asked *asked, int i)
{
    struct crown_pixel pixel;
    if (!crown_seen(eye, splash, i % RAIN_WIDTH, i / RAIN_WIDTH, &pixel) || !(pixel.cover > 0))
        return (struct glow){0, false, false};
    const struct glow glow = {pixel.cover * light_at(eye, asked->lamp, &pixel, splash, asked->matt),
                              true, asked->view->cut && is_cut(eye, &pixel)};
    due->cut += glow.is_cut;
    if (glow.is_cut)
        return glow;
    due->left[i] *= 1 - fmin(asked->opacity * pixel.cover, 1);
    due->most_hidden = fmax(due->most_hidden, asked->opacity * pixel.cover);
    return glow;
}

static void add(struct due *due, const struct crown_eye *eye, const struct crown_splash *splash,
                const struct asked *asked)
{
    static struct glow glows[RAIN_TEXELS];
    double peak = 0;
    int box[4];
    crown_reach(eye, splash, box);
    for (int y = box[1]; y < box[3]; y++)
        for (int x = box[0]; x < box[2]; x++) {
            const int i = y * RAIN_WIDTH + x;
            glows[i] = glow_at(due, eye, splash, asked, i);
            peak = fmax(peak, glows[i].full);
        }
    for (int y = box[1]; y < box[3]; y++)
        for (int x = box[0]; x < box[2]; x++) {
            const int i = y * RAIN_WIDTH + x;
            const double light = glows[i].is_cut ? 0 : glows[i].full;
            due->layers[i] += glows[i].is_there && !glows[i].is_cut;
            due->light[i] += light;
            due->peak[i] = fmax(due->peak[i], glows[i].is_there ? peak : 0);
        }
    due->splashes += peak > 0;
}

static struct due *due_of(const struct streaks *s, const struct asked *asked)
{
    struct due *due = calloc(1, sizeof(*due));
    assert_non_null(due);
    for (int i = 0; i < RAIN_TEXELS; i++)
        due->left[i] = 1;
    const struct crown_eye eye = eye_of(s);
    const struct rain_places places = rain_read_places(s);
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        if ((int)place[5] != STREAKS_SPLASH)
            continue;
        const struct crown_splash splash = splash_of(s, asked->view, place, i);
        add(due, &eye, &splash, asked);
    }
    free(places.words);
    return due;
}

// --- the comparison ---

struct verdict {
    int seen, off;
    double is, due;
};

// Each layer rounds light, by `rounded` at most.
static void judge(struct verdict *v, double is, double due, double peak, double rounded)
{
    if (!(peak > 0))
        return;
    v->seen++;
    v->off += !(fabs(is - due) <= 0.01 * peak + rounded);
    v->is += is;
    v->due += due;
}

static void expect(const struct verdict *v, const struct due *due, const char *what)
{
    print_message("%s: %d splashes, %d pixels, %d off, %d cut, bias %.3f %%\n", what, due->splashes,
                  v->seen, v->off, due->cut, 100 * (v->is / v->due - 1));
    assert_at_least(due->splashes, 5);
    assert_at_least(v->seen, 1000);
    if (!(v->off <= v->seen / 1000 && fabs(v->is / v->due - 1) <= 0.002))
        fail_msg("%s: %d of %d pixels are off, bias %g", what, v->off, v->seen, v->is / v->due - 1);
}

static struct streaks *open_view(const struct view *view, int width_mm, double drops, double gain,
                                 double opacity, const char *time)
{
    char settings[900];
    snprintf(settings, sizeof(settings), SETTINGS, mesh, lights, width_mm, drops, gain, opacity,
             time, view->settings);
    write_mesh(view->cut);
    struct streaks *s = rain_open(settings);
    rain_step(s, 30);
    return s;
}

static void expect_light(const struct view *view, const struct lamp *lamp, int width_mm,
                         double drops, bool matt)
{
    // A picture of halves shows no less than a 4,000th of its background.
    const double gain = width_mm < 100 ? 1000 : 64;
    write_lights(lamp);
    struct streaks *s =
        open_view(view, width_mm, drops, gain, 0, matt ? "night splash_light=matt" : "night");
    struct due *due = due_of(s, &(struct asked){view, lamp, 1, matt});
    struct rain_texels *wet = rain_read(s);
    s->params.splashes = 0;
    struct rain_texels *dry = rain_read(s);
    struct verdict v = {0};
    for (int i = 0; i < RAIN_TEXELS; i++)
        for (int c = 0; c < 3; c++)
            judge(&v,
                  rain_texel(wet, i % RAIN_WIDTH, i / RAIN_WIDTH, c) -
                      rain_texel(dry, i % RAIN_WIDTH, i / RAIN_WIDTH, c),
                  gain * colour[c] * due->light[i], gain * colour[c] * due->peak[i],
                  rain_texel(wet, i % RAIN_WIDTH, i / RAIN_WIDTH, c) * due->layers[i] / 1024);
    char what[128];
    snprintf(what, sizeof(what), "%s, %s%s, %d mm", view->name, lamp->type, matt ? ", matt" : "",
             width_mm);
    expect(&v, due, what);
    assert_true(!view->cut || due->cut > 100);
    free(wet);
    free(dry);
    free(due);
    rain_close(s);
}

// Crowns of clear water are small: 2 drops would light 663 pixels of 1,000.
static void test_light_by_kind_and_view(void **state)
{
    (void)state;
    for (int view = 0; view < VIEWS; view++)
        for (int lamp = 0; lamp < LAMPS; lamp++)
            if (!IS_SANITIZED || view == lamp) // each view and each lamp
                expect_light(&views[view], &lamps[lamp], 1800, 6, false);
}

static void test_light_of_small_ones(void **state)
{
    (void)state;
    expect_light(&views[0], &lamps[3], 500, 12, false);
    expect_light(&views[0], &lamps[3], 300, 40, false);
    // Thinner than a pixel, and drawn one pixel wide.
    expect_light(&views[0], &lamps[0], 40, 300, false);
    if (!IS_SANITIZED)
        expect_light(&views[2], &lamps[0], 40, 300, false);
}

static void test_matt_ones(void **state)
{
    (void)state;
    for (int lamp = 1; lamp < LAMPS; lamp++)
        expect_light(&views[0], &lamps[lamp], 1800, 2, true);
}

// Ten bits a component turn this normal by 0.02 degrees, and would lengthen it by 0.13 %.
static void test_light_on_thirty_degrees(void **state)
{
    (void)state;
    const double before[4] = {slope[0], slope[1], slope[2], unit_m};
    slope[1] = sqrt(0.75);
    slope[2] = 0.5;
    unit_m = 115 * slope[1] / slope[2];
    struct view view = views[0];
    const double up = rint(511 * slope[1]), out = rint(511 * slope[2]);
    view.normal[1] = up / hypot(up, out);
    view.normal[2] = out / hypot(up, out);
    view.name = "on 30 degrees";
    for (int lamp = 0; lamp < LAMPS; lamp++)
        for (int matt = lamp == 0; matt < 2; matt++) // the sky shows on both alike
            expect_light(&view, &lamps[lamp], 1800, 3, matt);
    memcpy(slope, before, sizeof(slope));
    unit_m = before[3];
}

static void expect_hidden(const struct view *view)
{
    const double opacity = 16, drops = view->cut ? 2 : 3;
    write_lights(&lamps[0]);
    struct streaks *s = open_view(view, 1800, drops, 0, 1, "day");
    s->params.splash_opacity = (float)opacity;
    struct due *due = due_of(s, &(struct asked){view, &lamps[0], opacity, false});
    struct rain_texels *wet = rain_read(s);
    s->params.splashes = 0;
    struct rain_texels *dry = rain_read(s);
    struct verdict v = {0};
    for (int i = 0; i < RAIN_TEXELS; i++) {
        const double before = rain_texel(dry, i % RAIN_WIDTH, i / RAIN_WIDTH, 1);
        const double hidden = 1 - rain_texel(wet, i % RAIN_WIDTH, i / RAIN_WIDTH, 1) / before;
        if (before > 0)
            judge(&v, hidden, 1 - due->left[i], fmin(opacity * due->peak[i], 1),
                  (due->layers[i] + 1) / 1024.0);
    }
    char what[128];
    snprintf(what, sizeof(what), "%s, hidden, %.2f at most", view->name, due->most_hidden);
    expect(&v, due, what);
    free(wet);
    free(dry);
    free(due);
    rain_close(s);
}

static void test_what_they_hide(void **state)
{
    (void)state;
    for (int view = 0; view < VIEWS; view++)
        expect_hidden(&views[view]);
}

int main(int argc, char **argv)
{
    snprintf(mesh, sizeof(mesh), "test_splashes_%ld.off", (long)getpid());
    snprintf(lights, sizeof(lights), "test_splashes_%ld.json", (long)getpid());
    make_films();
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_light_by_kind_and_view),
        cmocka_unit_test(test_light_of_small_ones),
        cmocka_unit_test(test_matt_ones),
        cmocka_unit_test(test_what_they_hide),
        cmocka_unit_test(test_light_on_thirty_degrees),
    };
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    remove(mesh);
    remove(lights);
    return status;
}
