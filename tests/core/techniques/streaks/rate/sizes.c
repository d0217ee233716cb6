// Drops of different sizes: sizes DEVICE. The particles' number, spectrum, water and flux against
// integrals of the same spectrum and speed law, from their formulas. Speeds are compared with Gunn
// and Kinzer's.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/spectrum.h"
#include "tests/core/techniques/streaks/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

static const double pi = 3.14159265358979323846, largest_mm = 6;
static const double rates[] = {1, 5, 20, 50, 100};
enum { RATES = sizeof(rates) / sizeof(rates[0]) };

// --- the formulas ---

struct rain {
    bool is_best;
    double rain_mm_h, least_mm;
    bool normalised; // so many drops that those of 0.1 to 6 mm make rain_mm_h
};

// Drops in a cubic metre, for each millimetre of diameter, as their authors give them.
static double density(const struct rain *r, double d)
{
    if (!r->is_best)
        return 8000 * exp(-4.1 * d / pow(r->rain_mm_h, 0.21));
    const double a = 1.30 * pow(r->rain_mm_h, 0.232);
    const double water =
        67 * pow(r->rain_mm_h, 0.846) * 2.25 * pow(d, 1.25) / pow(a, 2.25) * exp(-pow(d / a, 2.25));
    return water * 6 / (pi * d * d * d);
}

static double atlas(double d)
{
    return fmax(9.65 - 10.3 * exp(-0.6 * d), 0);
}

static double one(double d)
{
    (void)d;
    return 1;
}

static double volume(double d)
{
    return pi * d * d * d / 6;
}

static double section(double d)
{
    return pi / 4 * d * d;
}

static double flux(double d)
{
    return volume(d) * atlas(d) * 3.6e-3;
}

// Simpson's rule from the least diameter to `to`, over the density times `of`.
static double integral(const struct rain *r, double to, double (*of)(double d))
{
    enum { PARTS = 4000 };
    const double step = (to - r->least_mm) / PARTS;
    double sum = 0;
    for (int i = 0; i <= PARTS; i++) {
        const double d = r->least_mm + step * i;
        sum += density(r, d) * of(d) * (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2);
    }
    const struct rain all = {r->is_best, r->rain_mm_h, 0.1, false};
    return sum * step / 3 * (r->normalised ? r->rain_mm_h / integral(&all, largest_mm, flux) : 1);
}

// --- sums of the spectrum ---

static void near(const char *about, double is, double due, double share)
{
    if (!(fabs(is / due - 1) <= share))
        fail_msg("%s: %.6g, not %.6g", about, is, due);
}

static void test_sums(void **state)
{
    (void)state;
    for (int best = 0; best < 2; best++)
        for (int k = 0; k < RATES; k++) {
            const struct rain r = {best, rates[k], 0.5, false};
            const struct rg_spectrum spectrum = {
                best ? RG_BEST : RG_MARSHALL_PALMER, RG_ATLAS, rates[k], 0.5, largest_mm, 1};
            const struct rg_rainfall sum = rg_spectrum_rainfall(&spectrum);
            near("drops", sum.drops_m3, integral(&r, largest_mm, one), 1e-4);
            near("water", sum.water_mm3_m3, integral(&r, largest_mm, volume), 1e-4);
            near("rain", sum.rain_mm_h, integral(&r, largest_mm, flux), 1e-4);
            near("sections", sum.section_mm2_m3, integral(&r, largest_mm, section), 1e-4);
        }
    // In closed form: Marshall and Palmer's number, and Best's water.
    const double slope = 4.1 * pow(20, -0.21), a = 1.30 * pow(20, 0.232);
    const struct rg_spectrum mp = {RG_MARSHALL_PALMER, RG_ATLAS, 20, 0.7, 5, 1};
    near("drops", rg_spectrum_rainfall(&mp).drops_m3,
         8000 / slope * (exp(-0.7 * slope) - exp(-5 * slope)), 1e-5);
    const struct rg_spectrum best = {RG_BEST, RG_ATLAS, 20, 0.7, 5, 1};
    near("water", rg_spectrum_rainfall(&best).water_mm3_m3,
         67 * pow(20, 0.846) * (exp(-pow(0.7 / a, 2.25)) - exp(-pow(5 / a, 2.25))), 1e-5);
}

// Published values, one between two of them, and Atlas' fit, which is near them in its range.
// Best's rain has its nominal rate, within the differences between authors' spectra and speeds. In
// the hardest rain some water is in drops beyond 6 mm.
static void test_speeds(void **state)
{
    (void)state;
    static const double values[][2] = {{0.5, 2.06}, {1, 4.03},   {1.8, 6.09}, {2.6, 7.57},
                                       {4, 8.83},   {5.8, 9.17}, {1.1, 4.335}};
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); i++) {
        const double d = values[i][0];
        near("speed", rg_terminal_speed(RG_GUNN_KINZER, d), values[i][1], 1e-9);
        near("fit", rg_terminal_speed(RG_ATLAS, d), atlas(d), 1e-9);
        assert_below(fabs(rg_terminal_speed(RG_ATLAS, d) - rg_terminal_speed(RG_GUNN_KINZER, d)),
                     0.2);
    }
    for (int k = 0; k < RATES; k++) {
        const struct rg_spectrum all = {RG_BEST, RG_GUNN_KINZER, rates[k], 0.1, largest_mm, 1};
        near("Best's rain", rg_spectrum_rainfall(&all).rain_mm_h, rates[k],
             rates[k] > 50 ? 0.2 : 0.1);
    }
}

// A normalised spectrum has its rain rate, and the law's proportions.
static void test_normalised(void **state)
{
    (void)state;
    for (int best = 0; best < 2; best++)
        for (int k = 0; k < RATES; k++) {
            const enum rg_spectrum_kind kind = best ? RG_BEST : RG_MARSHALL_PALMER;
            struct rg_spectrum law = {kind, RG_GUNN_KINZER, rates[k], 0.1, largest_mm, 1};
            const struct rg_rainfall all = rg_spectrum_rainfall(&law);
            rg_spectrum_normalise(&law);
            near("rain", rg_spectrum_rainfall(&law).rain_mm_h, rates[k], 1e-9);
            law.least_mm = 1.3;
            const struct rg_rainfall kept = rg_spectrum_rainfall(&law);
            law.amount = 1;
            near("drops", kept.drops_m3,
                 rg_spectrum_rainfall(&law).drops_m3 * rates[k] / all.rain_mm_h, 1e-9);
        }
}

// Classes hold as many drops and as much water as the spectrum, and equally many that are kept.
static void test_classes(void **state)
{
    (void)state;
    enum { COUNT = 64 };
    struct rg_drop_class classes[COUNT];
    for (int keep = RG_KEEP_ALIKE; keep <= RG_KEEP_BY_STREAK; keep++) {
        struct rg_spectrum law = {RG_MARSHALL_PALMER, RG_ATLAS, 10, 0.3, largest_mm, 1};
        rg_spectrum_normalise(&law);
        const struct rg_rainfall all = rg_spectrum_rainfall(&law);
        double drops = 0, water = 0, chances[COUNT], mean = 0;
        rg_spectrum_classes(&law, (enum rg_spectrum_keep)keep, COUNT, classes);
        for (int i = 0; i < COUNT; i++) {
            const double d = classes[i].diameter_mm;
            drops += classes[i].drops_m3;
            water += classes[i].drops_m3 * volume(d);
            chances[i] = classes[i].drops_m3 * (keep == RG_KEEP_ALIKE ? 1 : d * d);
            chances[i] /= keep == RG_KEEP_BY_STREAK ? atlas(d) : 1;
            mean += chances[i] / COUNT;
        }
        near("drops", drops, all.drops_m3, 1e-9);
        near("water", water, all.water_mm3_m3, 1e-9);
        for (int i = 0; i < COUNT; i++) // the ends hold drops of more different sizes
            near("a class", chances[i], mean, i > 2 && i < COUNT - 2 ? 0.02 : 0.2);
    }
}

// --- the particles ---

// High above the city nothing is hit, so that each particle is a drop.
#define HIGH                                                                                       \
    "state=on geometry=off terminal_speed=atlas normalised=off packets=world blocks=all "          \
    "rain_height_m=400 "                                                                           \
    "camera=free eye_y_m=320 target_y_m=321 target_z_m=40 culling_radius_m=30 rain_width_m=60 "    \
    "rain_depth_m=60 "

struct drop {
    double diameter_mm, weight, speed_m_s;
};

static int by_diameter(const void *a, const void *b)
{
    const double d = ((const struct drop *)a)->diameter_mm - ((const struct drop *)b)->diameter_mm;
    return d < 0 ? -1 : d > 0;
}

// The drops, with their speeds measured over a frame. The caller frees them.
static struct drop *measure(struct streaks *s, int64_t *count)
{
    const double height = s->settings.local_height_m, step_s = s->settings.step_s;
    rain_step(s, 1);
    const struct rain_places before = rain_read_places(s);
    rain_step(s, 1);
    const struct rain_places after = rain_read_places(s);
    struct drop *drops = malloc((size_t)after.count * sizeof(*drops));
    assert_true(drops);
    assert_equals(before.count, after.count);
    *count = 0;
    for (int64_t i = 0; i < after.count; i++) {
        const float *a = before.words + i * STREAKS_STATE_WORDS;
        const float *b = after.words + i * STREAKS_STATE_WORDS;
        const double way = (double)b[2] - (double)a[2];
        if ((int)b[5] != STREAKS_DROP)
            continue;
        assert_equals(a[8], b[8]);
        assert_equals(a[9], b[9]);
        drops[(*count)++] = (struct drop){.diameter_mm = 2000 * (double)b[8],
                                          .weight = (double)b[9],
                                          .speed_m_s = (way < 0 ? way + height : way) / step_s};
    }
    free(before.words);
    free(after.words);
    qsort(drops, (size_t)*count, sizeof(*drops), by_diameter);
    return drops;
}

// Twice the standard deviation, where it is largest, of the share of drops up to a diameter: for
// drops of one weight 1 over the root of their number.
static double spread(const struct drop *drops, int64_t count)
{
    double sum = 0, squares = 0, before = 0, squares_before = 0, most = 0;
    for (int64_t i = 0; i < count; i++) {
        sum += drops[i].weight;
        squares += drops[i].weight * drops[i].weight;
    }
    for (int64_t i = 0; i < count; i++) {
        before += drops[i].weight / sum;
        squares_before += drops[i].weight * drops[i].weight;
        most = fmax(most, squares_before * pow(1 - before, 2) +
                              (squares - squares_before) * pow(before, 2));
    }
    return 2 * sqrt(most) / sum;
}

// The largest difference between the drops' share up to a diameter and the spectrum's.
static double furthest(const struct rain *r, const struct drop *drops, int64_t count)
{
    const double all = integral(r, largest_mm, one);
    double sum = 0, before = 0, most = 0;
    for (int64_t i = 0; i < count; i++)
        sum += drops[i].weight;
    for (int64_t i = 0, next = 0; i < count; i++) {
        before += drops[i].weight;
        if (i < next)
            continue; // integrals take long
        next = i + count / 200;
        most = fmax(most, fabs(before / sum - integral(r, drops[i].diameter_mm, one) / all));
    }
    return most;
}

// With a grid, an observer selects cells, and not all drops are there.
static void check_rain(const struct rain *r, const char *more)
{
    char settings[700];
    snprintf(settings, sizeof(settings),
             HIGH "spectrum=%s rain_mm_h=%g least_diameter_mm=%g kept_share=%g kept=%s",
             r->is_best ? "best" : "marshall-palmer", r->rain_mm_h, r->least_mm,
             200000 / (24000 * integral(r, largest_mm, one)), more);
    struct streaks *s = rain_open(settings);
    int64_t count;
    struct drop *drops = measure(s, &count);
    const double volume_m3 = 60 * 60 * s->settings.local_height_m * s->mean_density;
    double number = 0, water = 0, rain = 0;
    for (int64_t i = 0; i < count; i++) {
        const struct drop *d = &drops[i];
        assert_below(fabs(d->speed_m_s - atlas(d->diameter_mm)), 0.01);
        number += d->weight / volume_m3;
        water += d->weight * volume(d->diameter_mm) / volume_m3;
        rain += d->weight * volume(d->diameter_mm) * d->speed_m_s * 3.6e-3 / volume_m3;
    }
    const double most = furthest(r, drops, count);
    print_message("%s: %lld drops, off by %.4f of %.4f\n", settings + strlen(HIGH),
                  (long long)count, most, 1.63 * spread(drops, count) + 0.001);
    assert_above(count, 50000);
    const bool all = !strstr(more, "grid");
    const double due = integral(r, largest_mm, one), there = all ? 1 : number / due;
    near("drops", number, due * there, 0.02);
    near("water", water, integral(r, largest_mm, volume) * there, 0.02);
    near("rain", rain, integral(r, largest_mm, flux) * there, 0.02);
    // Kolmogorov-Smirnov test at 1 % for drops of these weights, and half a class of 512.
    assert_below(most, 1.63 * spread(drops, count) + 0.001);
    assert_below(spread(drops, count), 2 / sqrt((double)count)); // or weights are too uneven
    near("rain that is told", fact_of(&s->base, "rain_realised_mm_h"), rain / there,
         all ? 1e-3 : 0.02);
    near("rain that is kept", fact_of(&s->base, "rain_rate_mm_h"), integral(r, largest_mm, flux),
         1e-3);
    near("extinction", fact_of(&s->base, "extinction_per_km"),
         integral(r, largest_mm, section) / 1000, 1e-3);
    assert_equals(fact_of(&s->base, "rain_nominal_mm_h"), r->rain_mm_h);
    free(drops);
    rain_close(s);
}

static void test_rain(void **state)
{
    (void)state;
    for (int best = 0; best < 2; best++)
        for (int k = 0; k < RATES; k++)
            check_rain(&(struct rain){best, rates[k], 0.8, false}, "alike");
    check_rain(&(struct rain){true, 20, 0.5, false}, "section");
    check_rain(&(struct rain){false, 20, 0.3, false}, "streak");
    check_rain(&(struct rain){false, 20, 0.3, true}, "streak normalised=on"); // the default
    check_rain(&(struct rain){false, 20, 0.5, false}, "alike packets=grid packet_size=20000");
}

// Rain of one size, the thesis's, by its own formulas; and of a spectrum with its rain rate.
static void test_rate(void **state)
{
    (void)state;
    struct streaks *s = rain_open("spectrum=best look=thesis drops_m2_s=535.50222");
    near("rain", fact_of(&s->base, "rain_rate_mm_h"), 535.50222 * volume(3.2) * 3.6e-3, 1e-9);
    near("extinction", fact_of(&s->base, "extinction_per_km"),
         535.50222 / 8.16 * section(3.2) / 1000, 1e-9);
    rain_close(s);
    s = rain_open("look=photograph rain_mm_h=7");
    near("rain", fact_of(&s->base, "rain_rate_mm_h") + fact_of(&s->base, "rain_left_out_mm_h"), 7,
         1e-3);
    near("rain of particles", fact_of(&s->base, "rain_realised_mm_h"),
         fact_of(&s->base, "rain_rate_mm_h"), 0.02);
    rain_close(s);
}

// The drops left out below the least diameter, down to 0.1 mm.
static void test_left_out(void **state)
{
    (void)state;
    struct streaks *s = rain_open(HIGH "spectrum=best rain_mm_h=20 least_diameter_mm=2");
    const struct rain all = {true, 20, 0.1, false}, kept = {true, 20, 2, false};
    near("drops", fact_of(&s->base, "drops_left_out_m3"),
         integral(&all, largest_mm, one) - integral(&kept, largest_mm, one), 1e-3);
    near("water", fact_of(&s->base, "water_left_out_share"),
         1 - integral(&kept, largest_mm, volume) / integral(&all, largest_mm, volume), 1e-3);
    near("light", fact_of(&s->base, "light_left_out_share"),
         1 - integral(&kept, largest_mm, section) / integral(&all, largest_mm, section), 1e-3);
    near("rain", fact_of(&s->base, "rain_left_out_mm_h"),
         integral(&all, largest_mm, flux) - integral(&kept, largest_mm, flux), 0.01);
    rain_close(s);
}

int main(int argc, char **argv)
{
    struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sums),       cmocka_unit_test(test_speeds),
        cmocka_unit_test(test_normalised), cmocka_unit_test(test_classes),
        cmocka_unit_test(test_rain),       cmocka_unit_test(test_rate),
        cmocka_unit_test(test_left_out),
    };
    return rain_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
