// Rain on panes of sliding drops: its rate, its sizes, the account of what landed, and the shape of
// drops at rest. On cpu.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/techniques/flow/survey/convex.h"
#include "core/techniques/flow/inputs/rain.h"
#include "tests/core/techniques/flow/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

static const double PI = 3.14159265358979323846;

// --- a model of its own ---

// Lacy, 1965 (the formula of ISO 15927-3): an upright wall gets 0.222 R^0.88 mm/h for each metre a
// second of wind, R being the rate on level ground. Wind of 10 m/s makes 2.22 R^0.88 of it. Drops
// have the sizes of Marshall and Palmer's rain of R, from 0.5 to 6 mm.
static const double LEAST_MM = 0.5, MOST_MM = 6;
// Sizes are floats, so that panes are the same with every C library.
static const double ROUNDED = 1e-6;

static double ground_mm_h(double pane_mm_h)
{
    return pow(pane_mm_h / 2.22, 1 / 0.88);
}

static double slope_of(double pane_mm_h)
{
    return 4.1 * pow(ground_mm_h(pane_mm_h), -0.21);
}

// The share of drops whose diameter is below d.
static double share_below(double slope, double d)
{
    return (exp(-slope * LEAST_MM) - exp(-slope * d)) /
           (exp(-slope * LEAST_MM) - exp(-slope * MOST_MM));
}

static double sphere_mm3(double diameter_mm)
{
    return PI / 6 * pow(diameter_mm, 3);
}

// The diameter below which this share of drops is.
static double quantile_mm(double slope, double share)
{
    double low = LEAST_MM, high = MOST_MM;
    for (int i = 0; i < 60; i++) {
        const double d = (low + high) / 2;
        *(share_below(slope, d) < share ? &low : &high) = d;
    }
    return low;
}

static double mean_mm3(double slope)
{
    enum { STEPS = 20000 };
    double sum = 0, all = 0;
    for (int i = 0; i < STEPS; i++) {
        const double d = LEAST_MM + (i + 0.5) * (MOST_MM - LEAST_MM) / STEPS;
        sum += sphere_mm3(d) * exp(-slope * d);
        all += exp(-slope * d);
    }
    return sum / all;
}

// A cap by the radius of its contact: its height is radius tan(angle / 2).
static double cap_mm3(double contact_deg, double radius_mm)
{
    const double high_mm = radius_mm * tan(contact_deg * PI / 360);
    return PI / 6 * high_mm * (3 * radius_mm * radius_mm + high_mm * high_mm);
}

// Where the first drop stands in the spectrum. The others' shares follow by the golden ratio, so
// that each tells it to what its size is rounded to: their mean is closer.
static double first_share(const struct flow_rain *rain, int pane, double slope)
{
    enum { DROPS = 100 };
    double first = 0, off = 0;
    for (int i = 0; i < DROPS; i++) {
        const double volume_mm3 = flow_falling_drop(rain, pane, i).volume_mm3;
        const double share = share_below(slope, cbrt(volume_mm3 * 6 / PI));
        first = i ? first : share;
        off += remainder(share - first - i * (sqrt(5) - 1) / 2, 1) / DROPS;
    }
    return first + off;
}

// What lands on a pane within these seconds: the initial caps, and drops of the spectrum.
static double due_mm3(const struct flow_settings *s, int pane, double seconds)
{
    const struct flow_rain rain = flow_rain_of(s);
    const double slope = slope_of(s->pane_rain_mm_h);
    const double rain_mm3 = s->pane_rain_mm_h / 3600 * s->pane_mm * s->pane_mm * seconds;
    const double count = floor(rain_mm3 / mean_mm3(slope) + 1e-6);
    const double start = first_share(&rain, pane, slope);
    double sum = 0, whole;
    for (int i = 0; i < s->drops; i++)
        sum += cap_mm3(s->contact_deg, flow_initial_drop(&rain, pane, i).radius_mm);
    for (int i = 0; i < count; i++)
        sum += sphere_mm3(quantile_mm(slope, modf(start + i * (sqrt(5) - 1) / 2, &whole)));
    return sum;
}

// --- what lands ---

static double fallen_mm3(const struct flow_settings *s, int pane, int64_t frames)
{
    const struct flow_rain rain = flow_rain_of(s);
    double sum = 0;
    for (int64_t number = 0; number < flow_fallen_before(&rain, frames); number++)
        sum += flow_falling_drop(&rain, pane, number).volume_mm3;
    return sum;
}

// The drops that were drawn for a pane.
static double drawn_mm3(const struct rig *rig, int pane, int64_t frames)
{
    const struct flow_rain rain = flow_rain_of(&rig->settings);
    double sum = fallen_mm3(&rig->settings, pane, frames);
    for (int i = 0; i < rig->settings.drops; i++)
        sum += flow_initial_drop(&rain, pane, i).volume_mm3;
    return sum;
}

static void expect_landed(const char *set, double due_mm3, double landed, double share)
{
    if (fabs(due_mm3 - landed) > share * due_mm3)
        fail_msg("%s: %.9g mm3 landed of %.9g", set, landed, due_mm3);
}

// The ledger has the volume of the drops that were drawn, and of the model's, less a part of a
// droplet on each pane that the next drop brings. The first cases are the defaults.
static void test_the_ledger_has_what_landed(void **state)
{
    (void)state;
    static const struct {
        const char *set;
        double mm3; // of this seed
    } cases[] = {
        {"view=pane", 1691.473},
        {"view=box", 0},
        {"view=pane resolution_px=96 seed=2", 1654.520},
        {"view=pane resolution_px=64 pane_rain_mm_h=400 seed=3", 6310.784},
        {"view=pane resolution_px=128 contact_deg=90 drop_radius_max_mm=12 seed=4", 37008.539}};
    for (int i = 0; i < 5; i++) {
        char text[192];
        snprintf(text, sizeof(text), "move=sliding %s", cases[i].set);
        struct rig rig;
        rig_open(&rig, "cpu", text);
        double due = 0, drawn = 0;
        for (int pane = 0; pane < rig.panes; pane++) {
            due += due_mm3(&rig.settings, pane, 2);
            drawn += drawn_mm3(&rig, pane, 120);
        }
        const double landed = rig_sourced_mm3(&rig, 120),
                     part = rig.panes * rig_droplet_mm3(&rig) / drawn;
        print_message("%s: %.9g mm3 landed, %.9g drawn, %.9g due\n", cases[i].set, landed, drawn,
                      due);
        expect_landed(cases[i].set, due, landed, ROUNDED);
        expect_landed(cases[i].set, drawn, landed, part + 1e-9);
        expect_landed(cases[i].set, fact_of(rig.instance, "landed_mm3"), landed, part + 1e-9);
        expect_landed(cases[i].set, cases[i].mm3 > 0 ? cases[i].mm3 : due, landed, ROUNDED);
        rig_close(&rig);
    }
}

// A minute of 64 seeds: their mean is 0.07 % off at most. A single one is right too, because sizes
// are spread evenly: 2.01 % off at most, where it rains least.
static void test_it_rains_as_much_as_is_set(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    static const double rates[] = {5, 31, 120};
    for (int i = 0; i < 3; i++) {
        double sum = 0, worst = 0;
        s.pane_rain_mm_h = rates[i];
        for (s.seed = 1; s.seed <= 64; s.seed++) {
            const double due = rates[i] / 60 * s.pane_mm * s.pane_mm;
            const double share = fallen_mm3(&s, s.seed % 6, 3600) / due;
            sum += share / 64;
            worst = fmax(worst, fabs(share - 1));
        }
        print_message("%g mm/h: %.5f of it, a seed %.2f %% off at most\n", rates[i], sum,
                      100 * worst);
        assert_below(fabs(sum - 1), 0.002);
        assert_below(worst, 0.025);
    }
}

// 20 mm/h are 31 on the pane. Drops are counted by diameter.
static void test_sizes_are_of_the_spectrum(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    const struct flow_rain rain = flow_rain_of(&s);
    const double slope = slope_of(s.pane_rain_mm_h);
    enum { DROPS = 4000 };
    assert_below(fabs(ground_mm_h(s.pane_rain_mm_h) - 20), 0.1);
    for (double d = 0.6; d < 4; d += 0.2) {
        int below = 0;
        for (int i = 0; i < DROPS; i++)
            below += cbrt(flow_falling_drop(&rain, 0, i).volume_mm3 * 6 / PI) < d;
        assert_below(fabs((double)below / DROPS - share_below(slope, d)), 2e-3);
    }
}

// The largest drop is one of 6 mm, or an initial one: it sets the room for texels that drops cover.
static void test_the_largest_radius_is_known(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    s.drop_radius_min_mm = s.drop_radius_max_mm = 0.5;
    for (s.contact_deg = 20; s.contact_deg <= 90; s.contact_deg += 35) {
        const struct flow_rain rain = flow_rain_of(&s);
        const double largest_mm = flow_largest_radius_mm(&rain);
        assert_below(fabs(cap_mm3(s.contact_deg, largest_mm) / sphere_mm3(MOST_MM) - 1), ROUNDED);
    }
    s.drop_radius_max_mm = 40;
    const struct flow_rain rain = flow_rain_of(&s);
    assert_equals(flow_largest_radius_mm(&rain), 40);
}

static void test_the_rate_is_told(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, "cpu", "move=sliding resolution_px=64 pane_rain_mm_h=12.5");
    assert_equals(fact_of(rig.instance, "pane_rain_mm_h"), 12.5);
    rig_step(&rig, 30);
    assert_below(fabs(fact_of(rig.instance, "landed_mm3") / due_mm3(&rig.settings, 0, 0.5) - 1),
                 ROUNDED);
    rig_close(&rig);
}

// --- a drop that lands ---

// A cap has the contact angle at its rim and its volume in all, alone on a fine pane.
static void test_drops_land_as_caps(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    for (s.contact_deg = 30; s.contact_deg <= 90; s.contact_deg += 30) {
        const struct flow_rain rain = flow_rain_of(&s);
        const struct flow_drop drop = flow_falling_drop(&rain, 0, 7);
        const double step = drop.radius_mm / 20000, r = drop.radius_mm;
        double volume = 0;
        for (double d = step / 2; d < r; d += step)
            volume += 2 * PI * d * step * flow_cap_height_mm(&rain, r, d * d);
        const double rim = flow_cap_height_mm(&rain, r, (r - step) * (r - step)) / step;
        assert_below(fabs(volume / drop.volume_mm3 - 1), 1e-5);
        assert_below(fabs(cap_mm3(s.contact_deg, r) / drop.volume_mm3 - 1), ROUNDED);
        if (s.contact_deg < 90)
            assert_below(fabs(atan(rim) * 180 / PI - s.contact_deg), 0.1);
        assert_equals(flow_cap_height_mm(&rain, r, r * r * 1.001), 0);
    }
}

// --- at rest ---

static void test_hulls_are_measured(void **state)
{
    (void)state;
    // A cross of 5 texels fills its hull; an L of 3 x 3 has one of its three inner texels less.
    static const int cross[] = {1, 10, 11, 12, 21}, corner[] = {0, 10, 20, 21, 22}, one[] = {7},
                     line[] = {3, 4, 5};
    double room[3 * FLOW_CONVEX_ROOM][2];
    assert_equals(flow_convexity(cross, 5, 10, room), 1);
    assert_equals(flow_convexity(corner, 5, 10, room), 5.0 / 6);
    assert_equals(flow_convexity(one, 1, 10, room), 1);
    assert_equals(flow_convexity(line, 3, 10, room), 1);
}

// At the defaults 95 % of the drops at rest that are wider than 2 mm have an area of more than 95 %
// of their convex hull's.
static void test_drops_at_rest_are_round(void **state)
{
    (void)state;
    enum { LOOKS = 4 };
    struct rig rig;
    double resting = 0, convex = 0;
    rig_open(&rig, "cpu", "move=sliding survey=on");
    for (int look = 0; look < LOOKS; look++) {
        rig_step(&rig, look ? 120 : 600);
        free(rig_draw(&rig));
        resting += fact_of(rig.instance, "resting_above_2_mm");
        convex += fact_of(rig.instance, "resting_above_2_mm") *
                  fact_of(rig.instance, "resting_convex_percent") / 100;
    }
    print_message("%.2f %% of %g\n", 100 * convex / resting, resting);
    assert_above(resting, LOOKS * 100);
    assert_above(convex / resting, 0.95);
    rig_close(&rig);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_ledger_has_what_landed),
        cmocka_unit_test(test_it_rains_as_much_as_is_set),
        cmocka_unit_test(test_sizes_are_of_the_spectrum),
        cmocka_unit_test(test_the_largest_radius_is_known),
        cmocka_unit_test(test_the_rate_is_told),
        cmocka_unit_test(test_drops_land_as_caps),
        cmocka_unit_test(test_hulls_are_measured),
        cmocka_unit_test(test_drops_at_rest_are_round),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
