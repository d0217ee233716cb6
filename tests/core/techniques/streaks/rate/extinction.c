// The light that rain blocks on a kilometre, near and far: extinction DEVICE PAGE. Black drops hide
// a sky of one colour; the share of it that comes through, by the way of each pixel's ray through
// the rain, is compared with the sum of the drops' cross-sections, with measured extinction and
// with the figures that PAGE (docs/spectra.md) has.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/image/files/io.h"
#include "kernels/dialect/image/format.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"

static const double pi = 3.14159265358979323846;

// High above the ground, where no drop lands; the rain is as dense everywhere.
#define HIGH                                                                                       \
    "geometry=off splashes=off environment_light=off lights=0 streak_opacity=1 rain_width_m=300 "  \
    "rain_depth_m=300 rain_height_m=400 local_height_m=20 packets=grid cull=exact eye_y_m=200 "    \
    "target_y_m=200 target_z_m=40 view_angle_deg=40 "

enum { RADIUS_M = 20, LAYERS = 2, FRAMES = 2 };

// --- the law, in double precision ---

struct law {
    const char *name;
    bool is_best, normalised, is_fit;
};

// Gunn and Kinzer's speeds (1949), linearly interpolated, or Atlas' fit.
static double speed_of(bool is_fit, double d)
{
    static const double measured[][2] = {
        {0, 0},      {0.1, 0.27}, {0.2, 0.72}, {0.3, 1.17}, {0.4, 1.62}, {0.5, 2.06}, {0.6, 2.47},
        {0.7, 2.87}, {0.8, 3.27}, {0.9, 3.67}, {1, 4.03},   {1.2, 4.64}, {1.4, 5.17}, {1.6, 5.65},
        {1.8, 6.09}, {2, 6.49},   {2.2, 6.9},  {2.4, 7.27}, {2.6, 7.57}, {2.8, 7.82}, {3, 8.06},
        {3.2, 8.26}, {3.4, 8.44}, {3.6, 8.6},  {3.8, 8.72}, {4, 8.83},   {4.4, 8.98}, {4.8, 9.07},
        {5, 9.09},   {5.4, 9.14}, {5.8, 9.17}, {99, 9.17}};
    if (is_fit)
        return fmax(9.65 - 10.3 * exp(-0.6 * d), 0);
    int i = 0;
    while (d > measured[i + 1][0])
        i++;
    const double *a = measured[i], *b = measured[i + 1];
    return a[1] + (b[1] - a[1]) * (d - a[0]) / (b[0] - a[0]);
}

static double density(const struct law *law, double rate, double d)
{
    const double a = 1.30 * pow(rate, 0.232);
    return law->is_best ? 67 * pow(rate, 0.846) * 2.25 * pow(d / a, 1.25) / a *
                              exp(-pow(d / a, 2.25)) * 6 / (pi * d * d * d)
                        : 8000 * exp(-4.1 * d / pow(rate, 0.21));
}

// The cross-sections of drops of 0.3 to 6 mm in a cubic kilometre, over a square kilometre. The
// normalised law has its rain rate, of drops of 0.1 to 6 mm.
static double extinction_of(const struct law *law, double rate)
{
    enum { PARTS = 20000 };
    double section = 0, rain = 0;
    for (int i = 0; i < PARTS; i++) {
        const double d = 0.1 + (6 - 0.1) * (i + 0.5) / PARTS;
        const double drops = density(law, rate, d) * (6 - 0.1) / PARTS;
        section += d > 0.3 ? drops * pi / 4 * d * d : 0;
        rain += drops * pi / 6 * d * d * d * speed_of(law->is_fit, d) * 3.6e-3;
    }
    return section / 1000 * (law->normalised ? rate / rain : 1);
}

// --- pictures ---

static char map_path[64];

static void write_even_map(void)
{
    float white[4] = {1, 1, 1, 1};
    const struct rg_picture map = {.width = 1, .height = 1, .channels = 4, .texels = white};
    const struct rg_write_options options = {0};
    assert_true(rg_picture_write(map_path, &map, &options));
}

// The way of a pixel's ray over that of the view's axis.
static double longer(const struct streaks *s, int x, int y)
{
    const double focal = (double)s->params.focal_px;
    return hypot(1, hypot(x + 0.5 - RAIN_WIDTH / 2.0, y + 0.5 - RAIN_HEIGHT / 2.0) / focal);
}

// The share of light blocked on a kilometre, of rays through all the rain.
static double blocked(struct streaks *s, double reach_m)
{
    const double sky = (double)rg_unpack_half(rg_pack_half(scenery_day().sky.horizon_g));
    double depth = 0, way_m = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        rain_step(s, 30);
        struct rain_texels *picture = rain_read(s);
        for (int y = 0; y < RAIN_HEIGHT; y++)
            for (int x = 0; x < RAIN_WIDTH; x++) {
                depth -= log(rain_texel(picture, x, y, 1) / sky);
                way_m += longer(s, x, y) * reach_m;
            }
        free(picture);
    }
    return depth / way_m * 1000;
}

static double blocked_with(const char *rain, int layers)
{
    char settings[900];
    snprintf(settings, sizeof(settings), HIGH "culling_radius_m=%d density_map=%s %s", RADIUS_M,
             map_path, rain);
    struct streaks *s = rain_open(settings);
    const double is = blocked(s, (1 + layers) * RADIUS_M);
    rain_close(s);
    return is;
}

static double blocked_by(const struct law *law, double rate, int layers, const char *more)
{
    char rain[300];
    snprintf(rain, sizeof(rain),
             "spectrum=%s normalised=%s terminal_speed=%s rain_mm_h=%g far_layers=%d %s", law->name,
             law->normalised ? "on" : "off", law->is_fit ? "atlas" : "gunn-kinzer", rate, layers,
             more);
    return blocked_with(rain, layers);
}

// --- laws ---

static void expect_share(const char *about, double rate, double is, double due, double share)
{
    print_message("%s, %g mm/h: blocks %.4f a km, %.4f of what is due\n", about, rate, is,
                  is / due);
    if (!(fabs(is / due - 1) < share))
        fail_msg("%s, %g mm/h: blocks %.4f of the light a km, not %.4f", about, rate, is, due);
}

// Pictures block 0.3 to 2.9 % less than their drops' cross-sections, mostly as flat drops are
// narrower from the side than spheres.
static const double by_sections = 0.035;

// --- the default rain ---

enum { RATES = 5 };
static const double rates[RATES] = {1, 3, 10, 30, 100};

// The page's figure at a rate, "NUMBER at RATE"; -1: it has none.
static double said_at(const char *page, double rate)
{
    char unit[32];
    const char *sentence = strstr(page, "pictures of the default rain block");
    assert_non_null(sentence);
    snprintf(unit, sizeof(unit), " at %g", rate);
    for (const char *at = sentence; (at = strstr(at, unit)); at++)
        if (!(at[strlen(unit)] >= '0' && at[strlen(unit)] <= '9'))
            return at - sentence > 4 ? strtod(at - 4, NULL) : -1;
    return -1;
}

static const char *page_path;

// The page's text, with spaces for ends of lines. The caller frees it.
static char *read_page(void)
{
    enum { MOST = 1 << 16 };
    FILE *file = fopen(page_path, "r");
    char *page = calloc(1, MOST);
    assert_non_null(file);
    assert_non_null(page);
    assert_between(fread(page, 1, MOST, file), 1, MOST - 1);
    for (char *at = page; (at = strchr(at, '\n'));)
        *at = ' ';
    fclose(file);
    return page;
}

// look=photograph, with nothing else set but its rate, blocks what is measured: 0.312 R^0.63 a
// kilometre, of which diffraction is half. Its page has these figures.
static void test_as_measured(void **state)
{
    (void)state;
    const struct law law = {.normalised = true};
    char *page = read_page(), rain[64];
    for (int i = 0; i < RATES; i++) {
        snprintf(rain, sizeof(rain), "look=photograph rain_mm_h=%g", rates[i]);
        const double is = blocked_with(rain, 4), due = 0.156 * pow(rates[i], 0.63);
        expect_share("as measured", rates[i], is, due, 0.2);
        expect_share("by its own sections", rates[i], is, extinction_of(&law, rates[i]),
                     by_sections);
        const double said = said_at(page, rates[i]);
        if (!(fabs(said - is / due) < 0.00501))
            fail_msg("docs/spectra.md, %g mm/h: %.2f is %.4f", rates[i], said, is / due);
    }
    free(page);
}

// --- all rains ---

// Each spectrum, normalised or not, at both speeds; test_as_measured has the default.
static void test_laws(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        const struct law law = {i & 4 ? "best" : "marshall-palmer", i & 4, i & 1, i & 2};
        char about[64];
        snprintf(about, sizeof(about), "%s%s, %s speeds", law.name,
                 law.normalised ? ", normalised" : "", law.is_fit ? "fitted" : "measured");
        for (double rate = 1; rate < 101 && i != 1; rate *= 100)
            expect_share(about, rate, blocked_by(&law, rate, LAYERS, ""), extinction_of(&law, rate),
                         by_sections);
    }
}

// The thesis's rain, as many drops in a cubic metre as its flux over its speed. The database's
// drops swing, so that they are wider than spheres.
static void test_one_size(void **state)
{
    (void)state;
    const double radius_m = 0.0016, drops_m3 = 535 / 8.16,
                 due = drops_m3 * pi * radius_m * radius_m * 1000;
    static const char *const swings[] = {"swings=measured", "swings=database"};
    for (int i = 0; i < 2; i++) {
        char rain[100];
        snprintf(rain, sizeof(rain), "spectrum=off drops_m2_s=535 far_layers=%d %s", LAYERS,
                 swings[i]);
        expect_share(swings[i], 33.1, blocked_with(rain, LAYERS), due, by_sections);
    }
}

// Near rain alone, and what is kept of it.
static void test_near(void **state)
{
    (void)state;
    const struct law law = {"marshall-palmer", false, true, true};
    static const char *const kept[] = {"kept=alike", "kept=section", "kept=streak",
                                       "kept_share=0.6"};
    const double due = extinction_of(&law, 20);
    for (int i = 0; i < 4; i++)
        expect_share(kept[i], 20, blocked_by(&law, 20, 0, kept[i]), due, by_sections);
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {cmocka_unit_test(test_as_measured), cmocka_unit_test(test_laws),
                                 cmocka_unit_test(test_one_size), cmocka_unit_test(test_near)};
    page_path = argv[2];
    snprintf(map_path, sizeof(map_path), "test_extinction_%ld.exr", (long)getpid());
    write_even_map();
    const int status = rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
    remove(map_path);
    return status;
}
