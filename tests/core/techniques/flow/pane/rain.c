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
#include <string.h>

#include "core/techniques/flow/survey/convex.h"
#include "core/techniques/flow/inputs/rain.h"
#include "tests/core/techniques/flow/rig.h"
#include "tests/tools/expect.h"

static const double PI = 3.14159265358979323846;

// --- what lands ---

static double landed_mm3(const struct flow_settings *s, int pane, int64_t frames)
{
    const struct flow_rain rain = flow_rain_of(s);
    double sum = 0;
    for (int i = 0; i < s->drops; i++)
        sum += flow_initial_drop(&rain, pane, i).volume_mm3;
    for (int64_t number = 0; number < flow_fallen_before(&rain, frames); number++)
        sum += flow_falling_drop(&rain, pane, number).volume_mm3;
    return sum;
}

// The ledger counts droplets modulo 2^32; their volume is that of the drops that were drawn.
static void test_the_ledger_has_what_landed(void **state)
{
    (void)state;
    static const char *const cases[] = {
        "resolution_px=512", "resolution_px=96 seed=2",
        "resolution_px=64 pane_rain_mm_h=400 seed=3",
        "resolution_px=128 contact_deg=90 drop_radius_max_mm=12 seed=4"};
    for (int i = 0; i < 4; i++) {
        char text[192];
        snprintf(text, sizeof(text), "move=sliding view=pane %s", cases[i]);
        struct rig rig;
        rig_open(&rig, "cpu", text);
        const double texel_mm = rig.settings.pane_mm / rig.size;
        const double droplet_mm3 = texel_mm * texel_mm * rig.settings.relief / 65536;
        uint32_t before = 0;
        int64_t sourced = 0;
        for (int frame = 0; frame <= 120; frame++) {
            const uint32_t now = rig_ledger(&rig, FLOW_LEDGER_SOURCED);
            sourced += (uint32_t)(now - before);
            before = now;
            rig_step(&rig, frame < 120);
        }
        const double due = landed_mm3(&rig.settings, 0, 120);
        print_message("%s: %.9g mm3 of %.9g\n", cases[i], (double)sourced * droplet_mm3, due);
        assert_below(fabs((double)sourced * droplet_mm3 / due - 1), 1e-6);
        rig_close(&rig);
    }
}

// A minute of 64 seeds; a single one is right too, because sizes are spread evenly.
static void test_it_rains_as_much_as_is_set(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    s.drops = 0;
    static const double rates[] = {5, 31, 120};
    for (int i = 0; i < 3; i++) {
        double sum = 0, worst = 0;
        s.pane_rain_mm_h = rates[i];
        for (s.seed = 1; s.seed <= 64; s.seed++) {
            const double due = rates[i] / 60 * s.pane_mm * s.pane_mm;
            const double share = landed_mm3(&s, s.seed % 6, 3600) / due;
            sum += share / 64;
            worst = fmax(worst, fabs(share - 1));
        }
        print_message("%g mm/h: %.5f of it, a seed %.2f %% off at most\n", rates[i], sum,
                      100 * worst);
        assert_below(fabs(sum - 1), 0.01);
        assert_below(worst, 0.03);
    }
}

// Marshall and Palmer's exponent of 20 mm/h, which wind of 10 m/s drives to 31 on the pane: counted
// by diameter, above the least of 0.5 mm.
static void test_sizes_are_of_the_spectrum(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    const double rain_mm_h = pow(s.pane_rain_mm_h / 2.22, 1 / 0.88);
    const double slope = 4.1 * pow(rain_mm_h, -0.21), least = 0.5, most = 6;
    const struct flow_rain rain = flow_rain_of(&s);
    enum { DROPS = 4000 };
    assert_below(fabs(rain_mm_h - 20), 0.1);
    for (double d = 0.6; d < 4; d += 0.2) {
        int below = 0;
        for (int i = 0; i < DROPS; i++)
            below += cbrt(flow_falling_drop(&rain, 0, i).volume_mm3 * 6 / PI) < d;
        const double due =
            (exp(-slope * least) - exp(-slope * d)) / (exp(-slope * least) - exp(-slope * most));
        assert_below(fabs((double)below / DROPS - due), 2e-3);
    }
}

static double told(const struct rig *rig, const char *name)
{
    for (int i = 0; i < rig->instance->fact_count; i++)
        if (!strcmp(rig->instance->facts[i].name, name))
            return rig->instance->facts[i].number;
    fail_msg("no fact '%s'", name);
    return 0;
}

static void test_the_rate_is_told(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, "cpu", "move=sliding resolution_px=64 pane_rain_mm_h=12.5");
    assert_equals(told(&rig, "pane_rain_mm_h"), 12.5);
    rig_step(&rig, 30);
    assert_below(fabs(told(&rig, "landed_mm3") / landed_mm3(&rig.settings, 0, 30) - 1), 1e-12);
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
        resting += told(&rig, "resting_above_2_mm");
        convex += told(&rig, "resting_above_2_mm") * told(&rig, "resting_convex_percent") / 100;
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
        cmocka_unit_test(test_the_rate_is_told),
        cmocka_unit_test(test_drops_land_as_caps),
        cmocka_unit_test(test_hulls_are_measured),
        cmocka_unit_test(test_drops_at_rest_are_round),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
