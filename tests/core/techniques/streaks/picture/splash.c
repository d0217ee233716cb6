// The shape of splashes: splash DEVICE. With their textures replaced by a row or a frame of white,
// the lit pixels show their geometry. A splash is on the surface that is hit, along its normal. It
// has the size and duration of the synthesised animation, differs from others, and is lit by
// Lambert's law.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

// Crowns have 21 frames of 6 ms and 48 x 32 texels, which show 60 x 40 mm; the impact is 8 mm above
// the lower edge.
enum { FADE_RADIUS_M = 20 };
enum { FRAMES = 21, TEXELS_X = 48, TEXELS_Y = 32, FOOT_ROW = 25, WHITE = 0x3c00 };
static const double frame_s = 0.006, width_mm = 60, foot = 8.0 / 40, size_differs = 0.15;

// Splashes here are forty times as large, so that a row of their texels is pixels wide.
#define WIDE_M 2.4

// --- textures ---

// White in these rows of these frames, of all materials; black elsewhere. Levels after the first
// are black unless all rows are white. The textures belong to this test's own device.
static void paint(struct streaks *s, int first_row, int last_row, int first_frame, int last_frame)
{
    static uint16_t texels[TEXELS_Y][TEXELS_X], other[TEXELS_Y][TEXELS_X];
    const bool whole = first_row == 0 && last_row == TEXELS_Y - 1;
    struct rg_image *crowns = s->textures->crowns;
    for (int layer = 0; layer < crowns->desc.layers; layer++) {
        const int frame = layer % FRAMES;
        const bool shown = frame >= first_frame && frame <= last_frame;
        for (int y = 0; y < TEXELS_Y; y++)
            for (int x = 0; x < TEXELS_X; x++)
                texels[y][x] = shown && y >= first_row && y <= last_row ? WHITE : 0;
        assert_true(rg_image_write(crowns, layer, 0, texels));
        for (int i = 0; i < TEXELS_X * TEXELS_Y; i++)
            (&other[0][0])[i] = shown && whole ? WHITE : 0;
        for (int level = 1; level < crowns->desc.levels; level++)
            assert_true(rg_image_write(crowns, layer, level, other));
    }
}

// --- places ---

struct spot {
    double x, y, pixels_a_metre;
    bool is_seen;
};

// A place in the world, `up` metres along a normal from another.
static struct spot spot_of(const struct streaks *s, const double at[3], const double normal[3],
                           double up)
{
    const float *m = s->observer.world_to_clip;
    double clip[4];
    for (int i = 0; i < 4; i++) {
        clip[i] = (double)m[4 * i + 3];
        for (int c = 0; c < 3; c++)
            clip[i] += (double)m[4 * i + c] * (at[c] + normal[c] * up);
    }
    const struct spot spot = {(clip[0] / clip[3] + 1) / 2 * RAIN_WIDTH,
                              (clip[1] / clip[3] + 1) / 2 * RAIN_HEIGHT,
                              (double)s->observer.focal_px / clip[3], clip[3] > 0};
    return spot;
}

static void hit_of(const struct streaks *s, const float *place, double world[3])
{
    const double rain[3] = {(double)place[0], (double)place[1], (double)place[3]};
    rg_rain_world_point(&s->space, rain, world);
}

static bool is_splash(const float *place)
{
    return (int)place[5] == STREAKS_SPLASH;
}

// Whether a splash with this reach is in the picture, except for its part below the impact.
static bool is_inside(struct spot at, double reach_px)
{
    return at.is_seen && at.x > reach_px && at.x < RAIN_WIDTH - reach_px && at.y > reach_px &&
           at.y < RAIN_HEIGHT - reach_px / 2;
}

// --- lit pixels ---

struct lit {
    double sum, x, y, left, right; // left and right: where half of the light ends
    double most;
};

// The light that particle i of the state, alone, adds to the picture without rain.
static double *added_by(struct streaks *s, int64_t i, const struct rain_texels *dry)
{
    for (int64_t block = 0; block < s->selection.block_count; block++)
        s->selection.blocks[block * STREAKS_BLOCK_WORDS + 1] =
            block == i / STREAKS_BLOCK ? 1u << i % STREAKS_BLOCK : 0;
    assert_int_equal(s->selection.draw_count, 1);
    assert_true(streaks_write_blocks(s, &s->selection.draws[0]));
    struct rain_texels *lit = rain_read(s);
    double *added = malloc(RAIN_TEXELS * sizeof(*added));
    assert_non_null(added);
    for (int k = 0; k < RAIN_TEXELS; k++)
        added[k] = rain_texel(lit, k % RAIN_WIDTH, k / RAIN_WIDTH, 1) -
                   rain_texel(dry, k % RAIN_WIDTH, k / RAIN_WIDTH, 1);
    free(lit);
    return added;
}

static struct rain_texels *dry_picture(struct streaks *s)
{
    const streaks_params params = s->params;
    s->params.splashes = s->params.drops = 0;
    struct rain_texels *dry = rain_read(s);
    s->params = params;
    return dry;
}

// Calls `see` for each splash in the picture, drawn alone, at several moments.
typedef void see_fn(struct streaks *s, const float *place, const double *added, void *user);
static void each_splash(struct streaks *s, int moments, see_fn *see, void *user)
{
    for (int moment = 0; moment < moments; moment++) {
        struct rain_texels *dry = dry_picture(s);
        const struct rain_places places = rain_read_places(s);
        for (int64_t i = 0; i < places.count; i++) {
            const float *place = places.words + i * STREAKS_STATE_WORDS;
            double world[3];
            if (!is_splash(place))
                continue;
            hit_of(s, place, world);
            const struct spot at = spot_of(s, world, (double[]){0, 1, 0}, 0);
            if (!is_inside(at, 0.7 * WIDE_M * at.pixels_a_metre))
                continue;
            double *added = added_by(s, i, dry);
            see(s, place, added, user);
            free(added);
        }
        free(places.words);
        free(dry);
        rain_step(s, 5);
        s->params.sky_g = 1;
    }
}

static struct lit lit_around(const double *added, struct spot at, double reach_px)
{
    struct lit lit = {.left = 1e9, .right = -1e9};
    for (int y = (int)fmax(at.y - reach_px, 0); y < RAIN_HEIGHT && y <= at.y + reach_px; y++)
        for (int x = (int)fmax(at.x - reach_px, 0); x < RAIN_WIDTH && x <= at.x + reach_px; x++) {
            const double v = added[y * RAIN_WIDTH + x];
            if (v < 0.01)
                continue;
            lit.sum += v;
            lit.x += v * (x + 0.5);
            lit.y += v * (y + 0.5);
            lit.left = fmin(lit.left, x);
            lit.right = fmax(lit.right, x + 1);
            lit.most = fmax(lit.most, v);
        }
    lit.x /= lit.sum;
    lit.y /= lit.sum;
    return lit;
}

// --- scenes ---

#define LARGE                                                                                      \
    "state=on drops=off lights=0 splash_opacity=0 splash_width_mm=2400 drops_m2_s=4 "              \
    "view_angle_deg=20 last_mip=0 packets=world blocks=all "

static struct streaks *open_large(const char *settings)
{
    char all[960];
    snprintf(all, sizeof(all), LARGE "%s", settings);
    struct streaks *s = rain_open(all);
    rain_step(s, 30);
    s->params.sky_g = 1;
    return s;
}

static char path[64];

// A plane that rises towards -z, scaled to the width of the scene's space.
static void write_slope(double degrees)
{
    const double rise = 2 * tan(degrees / 180 * acos(-1));
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "OFF\n4 2 0\n-1 0 1\n1 0 1\n1 %.9f -1\n-1 %.9f -1\n3 0 1 2\n3 0 2 3\n", rise,
            rise);
    fclose(file);
}

// --- where they stand ---

// Splashes whose texture is one white row, and their measurements.
struct row {
    const double *normal;
    double above;             // of the row above the impact, in picture heights
    double least_height_m;    // of the surface that is hit
    int seen, missed, hidden; // in part, by things in front
    double least, most;       // widths over the settings' width
};

static void see_row(struct streaks *s, const float *place, const double *added, void *user)
{
    struct row *row = user;
    const double tall_m = WIDE_M * 2 / 3;
    double world[3];
    hit_of(s, place, world);
    const struct spot at = spot_of(s, world, row->normal, 0);
    if (world[1] < row->least_height_m || at.pixels_a_metre * WIDE_M < 42 ||
        (double)place[4] > 0.9 * s->settings.splash_s)
        return;
    const struct lit lit = lit_around(added, at, RAIN_WIDTH);
    row->seen++;
    row->missed += !(lit.sum > 0);
    if (!(lit.sum > 0))
        return;
    const double wide = (lit.right - lit.left) / at.pixels_a_metre / WIDE_M;
    row->hidden += wide < 0.78;
    if (wide < 0.78)
        return;
    // The height follows the splash's size, which differs.
    const struct spot low =
        spot_of(s, world, row->normal, row->above * tall_m * (1 - size_differs));
    const struct spot high =
        spot_of(s, world, row->normal, row->above * tall_m * (1 + size_differs));
    const double from_x = fmin(low.x, high.x), to_x = fmax(low.x, high.x);
    const double from_y = fmin(low.y, high.y), to_y = fmax(low.y, high.y);
    // Splashes face the eye. Off the picture's middle their nearer half is thus larger.
    if (!(lit.x > from_x - 1.5 && lit.x < to_x + 1.5 && lit.y > from_y - 1 && lit.y < to_y + 1))
        fail_msg("%.2f above: lit at %.2f, %.2f, not %.2f..%.2f, %.2f..%.2f", row->above, lit.x,
                 lit.y, from_x, to_x, from_y, to_y);
    row->least = fmin(row->least, wide);
    row->most = fmax(row->most, wide);
}

static void expect_row(const char *settings, const double normal[3], int number,
                       double least_height_m)
{
    struct streaks *s = open_large(settings);
    struct row row = {.normal = normal,
                      .above = 1 - (number + 0.5) / TEXELS_Y - foot,
                      .least_height_m = least_height_m,
                      .least = 1e9};
    paint(s, number, number, 0, FRAMES - 1);
    each_splash(s, 8, see_row, &row);
    print_message(
        "%s, row %d: %d splashes, %d missed, %d hidden in part, %.2f to %.2f times as wide\n",
        settings, number, row.seen, row.missed, row.hidden, row.least, row.most);
    assert_at_least(row.seen, 20);
    assert_equals(row.missed, 0);
    assert_at_most(row.hidden, row.seen / 12);
    assert_below(row.least, 0.95);
    assert_above(row.most, 1.05);
    assert_below(row.most, 1.25);
    rain_close(s);
}

#define STREET "eye_x_m=0 eye_y_m=3 eye_z_m=-15 target_x_m=0 target_y_m=0.3 target_z_m=-4 "
// A slope so slight that it is level, above the ground plane.
#define LEVEL                                                                                      \
    "scene=%s rain_height_m=80 eye_x_m=0 eye_y_m=3.2 eye_z_m=-11 target_x_m=0 target_y_m=0.5 "     \
    "target_z_m=0 "
static const double upright[3] = {0, 1, 0};

static void test_on_the_ground(void **state)
{
    (void)state;
    char settings[400];
    write_slope(0.05);
    snprintf(settings, sizeof(settings), LEVEL, path);
    expect_row(settings, upright, FOOT_ROW, 0.1);
    expect_row(settings, upright, 1, 0.1);
    snprintf(settings, sizeof(settings), LEVEL "splash_up=vertical", path);
    expect_row(settings, upright, FOOT_ROW, 0.1);
    // From near the ground, where parts below the impact would be hidden.
    snprintf(settings, sizeof(settings), LEVEL "eye_y_m=1.8 target_y_m=0.7", path);
    expect_row(settings, upright, FOOT_ROW, 0.1);
    remove(path);
}

#define SLOPE                                                                                      \
    "scene=%s eye_x_m=8 eye_y_m=119 eye_z_m=8 target_x_m=0 target_y_m=115.5 target_z_m=0 "         \
    "rain_height_m=400 local_height_m=40 depth_map_px=2048 "

static void test_on_a_slope(void **state)
{
    (void)state;
    char settings[400];
    const double normal[3] = {0, sqrt(3) / 2, 0.5};
    write_slope(30);
    snprintf(settings, sizeof(settings), SLOPE, path);
    expect_row(settings, normal, 1, 1);
    snprintf(settings, sizeof(settings), SLOPE "splash_up=vertical", path);
    expect_row(settings, upright, 1, 1);
    remove(path);
}

// --- how large, and how long ---

static void test_as_large_as_synthesised(void **state)
{
    (void)state;
    struct streaks *s = rain_open("");
    assert_below(fabs(s->settings.splash_width_mm - width_mm), 1e-9);
    assert_equals(s->settings.splash_gain, 1);
    assert_equals(s->settings.splash_opacity, 1);
    assert_below(fabs((double)s->params.splash_width - width_mm / 1000), 1e-7);
    rain_close(s);
    // A drop of half the size.
    s = rain_open("drop_radius_mm=0.8");
    assert_below(fabs((double)s->params.splash_width - width_mm / 2000), 1e-7);
    assert_below(fabs((double)s->params.splash_height - width_mm / 3000), 1e-7);
    rain_close(s);
}

static double brightest(const double *added)
{
    double most = 0;
    for (int i = 0; i < RAIN_TEXELS; i++)
        most = fmax(most, added[i]);
    return most;
}

// The seventh frame is white: a splash shines the more, the nearer its age is to that frame's
// middle.
enum { SHOWN = 6 };

static void see_frame(struct streaks *s, const float *place, const double *added, void *user)
{
    (void)s;
    int *counts = user;
    const double age_s = (double)place[4], is = brightest(added);
    const double due = fmax(1 - fabs(age_s / frame_s - (SHOWN + 0.5)), 0);
    counts[due > 0]++;
    if (fabs(is - due) > 0.03)
        fail_msg("at an age of %.4f s: %.3f, not %.3f", age_s, is, due);
}

static void test_frames_have_their_times(void **state)
{
    (void)state;
    int counts[2] = {0};
    struct streaks *s = open_large(STREET "geometry=off");
    paint(s, 0, TEXELS_Y - 1, SHOWN, SHOWN);
    assert_below(fabs(s->settings.splash_s - FRAMES * frame_s), 1e-9);
    each_splash(s, 12, see_frame, counts);
    print_message("%d splashes in the frame, %d in others\n", counts[1], counts[0]);
    assert_at_least(counts[1], 5);
    assert_at_least(counts[0], 20);
    rain_close(s);
}

// All frames are white: a splash is whole until its last frame, in which it fades out.
static void see_end(struct streaks *s, const float *place, const double *added, void *user)
{
    (void)s;
    int *counts = user;
    const double left = FRAMES - (double)place[4] / frame_s, due = fmin(left, 1);
    const double is = brightest(added);
    counts[due < 1]++;
    if (fabs(is - due) > 0.03)
        fail_msg("%.2f frames before its end: %.3f, not %.3f", left, is, due);
}

static void test_splashes_go_out(void **state)
{
    (void)state;
    int counts[2] = {0};
    struct streaks *s = open_large(STREET "geometry=off");
    paint(s, 0, TEXELS_Y - 1, 0, FRAMES - 1);
    each_splash(s, 12, see_end, counts);
    print_message("%d whole splashes, %d that go out\n", counts[0], counts[1]);
    assert_above(counts[0], 20);
    assert_at_least(counts[1], 3);
    rain_close(s);
}

// A splash is whole up to three quarters of the culling radius and gone at its end; in between it
// fades with the remaining distance.
static void see_fading(struct streaks *s, const float *place, const double *added, void *user)
{
    int *counts = user;
    const double eye[3] = {(double)s->params.eye_x, (double)s->params.eye_y};
    const double away = hypot((double)place[0] - eye[0], (double)place[1] - eye[1]);
    const double left = FRAMES - (double)place[4] / frame_s;
    const double share = fmin(fmax((FADE_RADIUS_M - away) / (FADE_RADIUS_M / 4.0), 0), 1);
    const double due = fmin(left, 1) * share, is = brightest(added);
    counts[share == 1 ? 0 : share > 0 ? 1 : 2]++;
    if (fabs(is - due) > 0.03)
        fail_msg("%.2f m away: %.3f, not %.3f", away, is, due);
}

static void test_splashes_fade_away(void **state)
{
    (void)state;
    int counts[3] = {0};
    char settings[200];
    snprintf(settings, sizeof(settings), STREET "geometry=off splash_fade=0.25 culling_radius_m=%d",
             FADE_RADIUS_M);
    struct streaks *s = open_large(settings);
    paint(s, 0, TEXELS_Y - 1, 0, FRAMES - 1);
    each_splash(s, 12, see_fading, counts);
    print_message("%d whole splashes, %d fading, %d gone\n", counts[0], counts[1], counts[2]);
    assert_above(counts[0], 5);
    assert_above(counts[1], 5);
    rain_close(s);
    s = rain_open("look=thesis");
    assert_equals(s->settings.splash_fade, 0);
    assert_equals(s->params.splash_fade, 0);
    rain_close(s);
}

// --- light ---

static void see_sun(struct streaks *s, const float *place, const double *added, void *user)
{
    const double *due = user;
    const double is = brightest(added);
    (void)place;
    if ((double)place[4] < 0.9 * s->settings.splash_s && fabs(is - *due) > 0.01)
        fail_msg("lit by %.3f, not %.3f", is, *due);
}

// A sun lights splashes by the cosine to their normal.
static void test_lamberts_law(void **state)
{
    (void)state;
    static const struct {
        const char *up;
        double normal[3];
    } ways[] = {{"normal", {0, 0.8660254, 0.5}}, {"vertical", {0, 1, 0}}};
    const double towards[3] = {-0.36, 0.8, 0.48};
    char settings[600], lights[64];
    snprintf(lights, sizeof(lights), "test_splash_lights_%ld.json", (long)getpid());
    FILE *file = fopen(lights, "w");
    assert_non_null(file);
    fprintf(file, "{\"lights\": [{\"type\": \"sun\", \"direction\": [0.36, -0.8, -0.48], "
                  "\"colour\": [1, 0.5, 1], \"shadows\": false}]}");
    fclose(file);
    write_slope(30);
    for (int k = 0; k < 2; k++) {
        double due = 0;
        for (int c = 0; c < 3; c++)
            due += 0.5 * towards[c] * ways[k].normal[c];
        snprintf(settings, sizeof(settings),
                 SLOPE "splash_up=%s splash_light=matt environment_light=off lights_file=%s", path,
                 ways[k].up, lights);
        struct streaks *s = open_large(settings);
        s->settings.environment_light = 0;
        paint(s, 0, TEXELS_Y - 1, 0, FRAMES - 1);
        s->params.sky_g = 0;
        each_splash(s, 1, see_sun, &due);
        rain_close(s);
    }
    remove(lights);
    remove(path);
}

// Splashes of the thesis's rain are many and faint, as water is: of a street's pixels by day, more
// are seen than are bright. White crowns made a tenth of them half as bright again.
static void test_splashes_are_faint(void **state)
{
    (void)state;
    struct streaks *s =
        rain_open(STREET "view_angle_deg=10 drops_m2_s=535 lights=1 time=day drops=off");
    rain_step(s, 30);
    struct rain_texels *wet = rain_read(s), *dry = dry_picture(s);
    int seen = 0, bright = 0;
    for (int i = 0; i < RAIN_TEXELS; i++) {
        const int x = i % RAIN_WIDTH, y = i / RAIN_WIDTH;
        const double ratio = rain_texel(wet, x, y, 1) / rain_texel(dry, x, y, 1);
        seen += ratio > 1.02;
        bright += ratio > 1.5;
    }
    print_message("of %d pixels %d show a splash, %d half as bright again\n", RAIN_TEXELS, seen,
                  bright);
    assert_above(seen, RAIN_TEXELS / 100);
    assert_below(bright, RAIN_TEXELS / 200);
    free(wet);
    free(dry);
    rain_close(s);
}

int main(int argc, char **argv)
{
    snprintf(path, sizeof(path), "test_splash_%ld.off", (long)getpid());
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_splashes_are_faint), // first, before crowns are painted white
        cmocka_unit_test(test_on_the_ground),           cmocka_unit_test(test_on_a_slope),
        cmocka_unit_test(test_frames_have_their_times), cmocka_unit_test(test_splashes_go_out),
        cmocka_unit_test(test_splashes_fade_away),      cmocka_unit_test(test_lamberts_law),
        cmocka_unit_test(test_as_large_as_synthesised),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
