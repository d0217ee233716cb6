// The area that streaks cover, by a law that needs no atlas: cover DEVICE. At each moment of the
// exposure a drop covers its cross-section, which swings. So under an even sky drops add the sum of
// their mean cross-sections to a picture, for any exposure, speed, resolution and view.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "tests/core/techniques/streaks/rig.h"
#include "tests/oracle/optics/drop.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/sanitized.h"

static const double pi = 3.14159265358979323846;

// So much light that the night's background does not count.
enum { MOMENTS = 32, GAIN = 1000, SKY = 16 };

// --- cross-sections ---

// The distance of a drop's outline from its middle, seen from an elevation, in a direction about
// the view. It is the farthest that the surface reaches to that side.
static double outline_at(const struct oracle_drop *drop, double elevation, double about)
{
    double farthest = 0;
    for (int k = -10; k <= 10; k++) {
        const double ahead = sin(k * 0.06), beside = cos(k * 0.06), up = beside * cos(about);
        const double n[3] = {beside * sin(about), up * cos(elevation) + ahead * sin(elevation),
                             ahead * cos(elevation) - up * sin(elevation)};
        farthest = fmax(farthest, oracle_drop_radius(drop, n) * beside);
    }
    return farthest;
}

// The mean cross-section of an oscillation over an exposure, over that of a sphere.
static double section_of(bool database, int oscillation, double elevation)
{
    enum { TIMES = 16, WAYS = 24 };
    double sum = 0;
    for (int time = 0; time < TIMES; time++) {
        const struct oracle_drop drop = oracle_drop_at(database, oscillation, (time + 0.5) / TIMES);
        for (int way = 0; way < WAYS; way++)
            sum += pow(outline_at(&drop, elevation, 2 * pi * (way + 0.5) / WAYS), 2);
    }
    return sum / (TIMES * WAYS);
}

enum { VIEWS = 5 };

// The mean of all oscillations of a set, which are equally frequent, in the atlas' views: at 0, 20,
// ... 80 degrees.
static double sections[2][VIEWS];

static void find_sections(void)
{
    for (int database = 0; database < 2; database++)
        for (int view = 0; view < VIEWS; view++)
            for (int oscillation = 0; oscillation < 10; oscillation++)
                sections[database][view] += section_of(database, oscillation, view * pi / 9) / 10;
}

// As the atlas is blended: evenly between two views, and the last one beyond it.
static double section_at(bool database, double elevation)
{
    const double view = fmin(elevation * 9 / pi, VIEWS - 1), *of = sections[database];
    const int lower = (int)fmin(view, VIEWS - 2);
    return of[lower] + (of[lower + 1] - of[lower]) * (view - lower);
}

// --- the law ---

// The pixels of a sphere's solid angle in perspective, if its middle is in the picture; otherwise
// 0.
static double pixels_of(const struct streaks *s, double x, double y, double z, double radius_m)
{
    const streaks_params *p = &s->params;
    const rg_corner c = m4_project(p->to_clip, v3_make((float)x, (float)y, (float)z));
    if (c.w <= 0 || fabsf(c.x) > c.w || fabsf(c.y) > c.w)
        return 0;
    const double across = hypot(x - (double)p->eye_x, y - (double)p->eye_y);
    const double down = z - (double)p->eye_s, away = hypot(across, down);
    const double cosine = (double)c.w / away, focal = (double)p->focal_px;
    const double section =
        section_at(s->settings.swings == RG_SWINGS_DATABASE, atan2(fabs(down), across));
    return section * pi * pow(radius_m / away * focal, 2) / pow(cosine, 3);
}

// The settings' speed, or Atlas' fit for drops of a spectrum.
static double speed_of(const struct streaks *s, double radius_m)
{
    return s->settings.spectrum ? 9.65 - 10.3 * exp(-0.6 * 2000 * radius_m)
                                : s->settings.fall_speed_m_s;
}

// The pixels that all drops cover in the mean over the exposure. Counts the drops that are seen.
static double pixels_due(const struct streaks *s, int *seen)
{
    const struct rain_places places = rain_read_places(s);
    double sum = 0;
    *seen = 0;
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        if ((int)place[5] != STREAKS_DROP)
            continue;
        double pixels = 0;
        const double radius_m = (double)place[8],
                     fall_m = speed_of(s, radius_m) * s->settings.exposure_s;
        for (int k = 0; k < MOMENTS; k++) {
            const double at = (double)place[2] - fall_m * (k + 0.5) / MOMENTS;
            if (at < (double)place[3])
                pixels += pixels_of(s, (double)place[0], (double)place[1], at, radius_m) / MOMENTS;
        }
        *seen += pixels > 0;
        sum += pixels * (double)place[9];
    }
    free(places.words);
    return sum;
}

// The light of a picture, which is freed.
static double light_of(struct rain_texels *picture)
{
    double sum = 0;
    for (int y = 0; y < RAIN_HEIGHT; y++)
        for (int x = 0; x < RAIN_WIDTH; x++)
            sum += rain_texel(picture, x, y, 1);
    free(picture);
    return sum;
}

// Black drops add nothing.
static double light_under(struct streaks *s, float sky)
{
    s->params.sky_g = sky;
    return light_of(rain_read(s));
}

static struct streaks *open_drops(const char *settings, int gain)
{
    char all[1280];
    snprintf(all, sizeof(all),
             "state=on geometry=off splashes=off lights=0 time=night streak_opacity=0 "
             "streak_gain=%d rain_width_m=30 rain_depth_m=30 rain_height_m=150 local_height_m=50 "
             "culling_radius_m=42 drops_m2_s=60 %s",
             gain, settings);
    struct streaks *s = rain_open(all);
    rain_step(s, 2);
    return s;
}

// The pixels that drops cover, and those that they should cover.
struct cover {
    double is, due;
};

static struct cover cover_of(const char *about, const char *settings, int gain, float sky,
                             double room)
{
    struct streaks *s = open_drops(settings, gain);
    const double lit = light_under(s, sky), dry = light_under(s, 0);
    int seen;
    const struct cover c = {(lit - dry) / (gain * (double)sky), pixels_due(s, &seen)};
    assert_above(seen, 2000);
    print_message("%s: %.4f of what is due\n", about, c.is / c.due);
    if (!(fabs(c.is / c.due - 1) < room))
        fail_msg("%s: %d drops cover %.1f pixels, %.3f of their cross-sections", about, seen, c.is,
                 c.is / c.due);
    rain_close(s);
    return c;
}

static void expect_cross_sections(const char *about, const char *settings)
{
    cover_of(about, settings, GAIN, SKY, 0.0125); // 1.2 % at most
}

// From so far away that all drops count about the same.
#define BESIDE "eye_z_m=-26 target_y_m=3 target_z_m=0 "

static void test_views(void **state)
{
    (void)state;
    expect_cross_sections("from the side", BESIDE "view_angle_deg=30");
    expect_cross_sections("from 75 degrees below",
                          "eye_z_m=-18 target_y_m=63 target_z_m=-2 view_angle_deg=12 "
                          "local_height_m=130");
    expect_cross_sections("from 60 degrees above",
                          "eye_y_m=60 eye_z_m=-26 target_y_m=17 target_z_m=-1 view_angle_deg=15 "
                          "local_height_m=110");
    expect_cross_sections("of the database, from the side",
                          BESIDE "swings=database view_angle_deg=30");
    expect_cross_sections("of the database, from 40 degrees below",
                          "swings=database eye_z_m=-26 target_y_m=25 target_z_m=0 "
                          "view_angle_deg=20 local_height_m=100");
}

static void test_exposures(void **state)
{
    (void)state;
    expect_cross_sections("1/1000 s", BESIDE "view_angle_deg=30 exposure_s=0.001");
    expect_cross_sections("1/4 s, from 40 degrees below",
                          "eye_z_m=-26 target_y_m=25 target_z_m=0 view_angle_deg=20 "
                          "exposure_s=0.25 local_height_m=100");
}

static void test_drops(void **state)
{
    (void)state;
    expect_cross_sections("small", BESIDE "view_angle_deg=30 drop_radius_mm=0.8");
    expect_cross_sections("slow", BESIDE "view_angle_deg=30 fall_speed_m_s=4");
    // From so near that drops are six pixels wide.
    expect_cross_sections("wide", BESIDE "view_angle_deg=3 drop_radius_mm=6 drops_m2_s=3000");
}

// Small drops stand for many, and are as bright.
static void test_sizes(void **state)
{
    (void)state;
    expect_cross_sections("a spectrum", BESIDE "view_angle_deg=30 spectrum=marshall-palmer "
                                               "terminal_speed=atlas rain_mm_h=30 kept_share=0.02");
    expect_cross_sections("a spectrum kept by cross-sections",
                          BESIDE "view_angle_deg=30 spectrum=best terminal_speed=atlas "
                                 "rain_mm_h=10 least_diameter_mm=0.6 kept=section kept_share=0.02");
}

// --- at the default gain, before the sky by day and by night ---

static void expect_ratio(const char *about, const struct cover *c, const struct cover *of,
                         double due)
{
    print_message("%s: %.4f of the light, %.4f of what is due\n", about, c->is / of->is,
                  c->is / c->due);
    if (!(fabs(c->is / of->is / due - 1) < 0.015))
        fail_msg("%s: %.4f of the light, not %.2f", about, c->is / of->is, due);
}

// For the same number of drops, light does not depend on exposure or speed, and grows with the
// square of the radius. The sky is as bright as by day, or a thirtieth of that. By night a quarter
// of the light is 1.6 % above what is due, and with ten times the gain 0.5 %: halves round the
// rest.
static void test_faint_light(void **state)
{
    (void)state;
    enum { CASES = 5 };
    static const char *const times[] = {"time=day", "time=night"};
    for (int night = 0; night < (IS_SANITIZED ? 1 : 2); night++) {
        const float sky = night ? 0.02f : 0.64f;
        char settings[CASES][200];
        static const char *const others[CASES] = {
            "drops_m2_s=535.5", "drops_m2_s=535.5 exposure_s=0.0666667",
            "drops_m2_s=535.5 drop_radius_mm=0.8", "fall_speed_m_s=4 drops_m2_s=262.5",
            "drops_m2_s=2142 drop_radius_mm=0.8"};
        struct cover covers[CASES];
        for (int i = 0; i < CASES; i++) {
            snprintf(settings[i], sizeof(settings[i]),
                     "%s eye_z_m=-26 target_y_m=25 target_z_m=0 view_angle_deg=20 "
                     "local_height_m=100 %s",
                     times[night], others[i]);
            covers[i] = cover_of(others[i], settings[i], 1, sky, night && i == 2 ? 0.0175 : 0.0125);
        }
        expect_ratio("four times the exposure", &covers[1], &covers[0], 1);
        expect_ratio("half the radius", &covers[2], &covers[0], 0.25);
        expect_ratio("half the speed", &covers[3], &covers[0], 1);
        expect_ratio("half the radius, four times as many", &covers[4], &covers[0], 1);
    }
}

// The most light among a pixel and its neighbours.
static double most_around(const struct rain_texels *picture, int column, int row)
{
    double most = 0;
    for (int y = row - 1; y <= row + 1; y++)
        for (int x = column - 1; x <= column + 1; x++)
            most = fmax(most, rain_texel(picture, x, y, 1));
    return most;
}

// Every drop is seen, however thin its streak: here a fortieth of a pixel, and with the shorter
// exposure a fiftieth long.
static void expect_all_seen(const char *settings)
{
    struct streaks *s = open_drops(settings, GAIN);
    s->params.sky_g = 0;
    struct rain_texels *dry = rain_read(s);
    s->params.sky_g = SKY;
    struct rain_texels *lit = rain_read(s);
    const struct rain_places places = rain_read_places(s);
    int drops = 0, missed = 0;
    for (int64_t i = 0; i < places.count; i++) {
        const float *place = places.words + i * STREAKS_STATE_WORDS;
        const rg_corner c = m4_project(
            s->params.to_clip, v3_make(place[0], place[1], place[2] - 0.5f * s->params.fall));
        const double x = (double)(c.x / c.w + 1) / 2 * RAIN_WIDTH,
                     y = (double)(c.y / c.w + 1) / 2 * RAIN_HEIGHT;
        if ((int)place[5] != STREAKS_DROP || c.w <= 0 || place[2] > place[3] ||
            !(x >= 1 && x < RAIN_WIDTH - 1 && y >= 1 && y < RAIN_HEIGHT - 1))
            continue;
        drops++;
        missed += !(most_around(lit, (int)x, (int)y) > most_around(dry, (int)x, (int)y));
    }
    assert_above(drops, 50);
    assert_int_equal(missed, 0);
    free(places.words);
    free(lit);
    free(dry);
    rain_close(s);
}

static void test_thin_streaks(void **state)
{
    (void)state;
    expect_all_seen(BESIDE "view_angle_deg=30 drops_m2_s=1");
    expect_all_seen(BESIDE "view_angle_deg=30 drops_m2_s=1 exposure_s=0.0004");
}

// Between its views, 20 degrees apart, the atlas is blended.
static void test_views_are_near_enough(void **state)
{
    (void)state;
    double most = 0;
    for (int step = 0; step <= 18; step++) {
        double due = 0;
        for (int oscillation = 0; oscillation < 10; oscillation++)
            due += section_of(false, oscillation, step * pi / 36) / 10;
        most = fmax(most, fabs(section_at(false, step * pi / 36) / due - 1));
    }
    print_message("a blend of views has a cross-section that is off by %.4f\n", most);
    assert_below(most, 0.005); // 0.0025
}

int main(int argc, char **argv)
{
    find_sections();
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_views),
        cmocka_unit_test(test_exposures),
        cmocka_unit_test(test_drops),
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_thin_streaks),
        cmocka_unit_test(test_faint_light),
        cmocka_unit_test(test_views_are_near_enough),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
