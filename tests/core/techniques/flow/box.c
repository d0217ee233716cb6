// flow's water on the six panes of the box. Water that crosses an edge arrives where geometry says,
// and none is lost. box DEVICE runs on it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/flow/rig.h"
#include "tests/oracle/flow/box.h"
#include "tests/tools/expect.h"

static const char *device = "cpu:reference";

enum { SIZE = 24, UNIT = 65536, TEXELS = BOX_PANES * SIZE * SIZE };

// No drops, noise 1, and a remainder of 1/4 wherever water moves.
static const char *const plain = "view=box resolution_px=24 drops=0 rain_drops_s=0 noise_low=1 "
                                 "remainder_low=0.25 remainder_low_height=0 ";

static void open_plain(struct rig *rig, const char *assignments)
{
    char text[512];
    snprintf(text, sizeof(text), "%s%s", plain, assignments);
    rig_open(rig, device, text);
}

static uint32_t noise(uint32_t i)
{
    i = (i ^ i >> 16) * 0x7feb352du;
    i = (i ^ i >> 15) * 0x846ca68bu;
    return i ^ i >> 16;
}

// --- where water goes ---

// One step of the box, computed for each texel: its water afterwards, and the water that left.
struct expected {
    double water[TEXELS];
    double drained;
    int crossings[BOX_PANES][BOX_PANES]; // parts that went from one pane to another
    int falls[BOX_PANES][BOX_PANES];     // parts that fell off there
};

// The settings that divide water.
struct rule {
    bool split;
    int reach;
    double threshold, fast, share; // L, M and r
};

static void give_part(struct expected *e, const struct box_oracle *box, struct box_texel from,
                      const int step[2], int texels, double droplets)
{
    struct box_texel to;
    if (droplets < 0.5)
        return;
    const bool kept = box_oracle_walk(box, SIZE, from, texels * step[0], texels * step[1], &to);
    if (to.pane != from.pane)
        (kept ? e->crossings : e->falls)[from.pane][to.pane]++;
    if (kept)
        e->water[(to.pane * SIZE + to.y) * SIZE + to.x] += droplets;
    else
        e->drained += droplets;
}

// Divides water along one direction. A share r of the water that reaches a texel goes on to the
// next, up to the reach. Each further texel needs M - L more water.
static void give_along(struct expected *e, const struct box_oracle *box, const struct rule *rule,
                       struct box_texel from, const int step[2], double water, double droplets)
{
    double left = droplets, needed = rule->fast;
    for (int texels = 1; texels <= rule->reach; texels++) {
        const bool goes_on = texels < rule->reach && water > needed;
        const double further = goes_on ? floor(left * rule->share + 1e-6) : 0;
        give_part(e, box, from, step, texels, left - further);
        left = further;
        needed += rule->fast - rule->threshold;
    }
}

static void eighth_of(double eighth, int step[2])
{
    const double angle = eighth * 3.14159265358979323846 / 4;
    step[0] = (int)lround(1.2 * cos(angle));
    step[1] = (int)lround(1.2 * sin(angle));
}

static void give(struct expected *e, const struct box_oracle *box, const struct rule *rule,
                 struct box_texel from, int64_t droplets)
{
    const double(*f)[3] = box->frames[from.pane];
    const double gravity[2] = {-f[0][1], -f[1][1]}, water = (double)droplets / UNIT;
    const double given = water > rule->threshold
                             ? floor((double)droplets * 0.75 * hypot(gravity[0], gravity[1]))
                             : 0;
    e->water[(from.pane * SIZE + from.y) * SIZE + from.x] += (double)droplets - given;
    const double eighths = atan2(gravity[1], gravity[0]) * 4 / 3.14159265358979323846;
    const double whole = rule->split ? floor(eighths) : floor(eighths + 0.5);
    const double second = rule->split ? floor(given * (eighths - whole)) : 0;
    int step[2];
    eighth_of(whole, step);
    give_along(e, box, rule, from, step, water, given - second);
    eighth_of(whole + 1, step);
    give_along(e, box, rule, from, step, water, second);
}

// Wet texels at random, most of them near edges, with amounts on both sides of every threshold.
static int64_t *make_wet(uint32_t seed)
{
    int64_t *water = calloc(TEXELS, sizeof(*water));
    for (int i = 0; i < TEXELS; i++) {
        const int x = i % SIZE, y = i / SIZE % SIZE;
        const int edge = (int)fmin(fmin(x, SIZE - 1 - x), fmin(y, SIZE - 1 - y));
        const uint32_t r = noise((uint32_t)i + 7919 * seed);
        if (r % (edge < 5 ? 3 : 9) == 0)
            water[i] = (int64_t)(noise(r) % (3 * UNIT));
    }
    return water;
}

static void expect_step(struct rig *rig, const struct box_oracle *box, const struct rule *rule,
                        uint32_t seed, struct expected *e)
{
    int64_t *before = make_wet(seed);
    const uint32_t drained = rig_ledger(rig, FLOW_LEDGER_DRAINED);
    rig_put(rig, before);
    rig_step(rig, 1);
    int64_t *after = rig_water(rig);
    memset(e->water, 0, sizeof(e->water));
    e->drained = 0;
    for (int i = 0; i < TEXELS; i++)
        if (before[i])
            give(e, box, rule, (struct box_texel){i / (SIZE * SIZE), i % SIZE, i / SIZE % SIZE},
                 before[i]);
    // The kernels round down to whole droplets in single precision, and the oracle in double. That
    // makes one droplet a part, and a texel takes 16 parts at most.
    for (int i = 0; i < TEXELS; i++)
        if (fabs((double)after[i] - e->water[i]) > 16)
            fail_msg("pane %d, texel (%d, %d): %lld droplets, %g expected", i / (SIZE * SIZE),
                     i % SIZE, i / SIZE % SIZE, (long long)after[i], e->water[i]);
    const double gone = rig_ledger(rig, FLOW_LEDGER_DRAINED) - drained;
    if (fabs(gone - e->drained) > 4000)
        fail_msg("%g droplets left the box, %g expected", gone, e->drained);
    free(before);
    free(after);
}

// Poses of a box on an edge or a corner, slightly turned. Each axis in turn is near the vertical,
// either end up; the other two are up to 18 degrees off the horizontal, either way.
enum { STANDS = 24 };

static void stand(int i, double *pitch_deg, double *roll_deg)
{
    static const double rolls[8] = {18, -18, 162, -162, 72, -72, 108, -108},
                        diagonals[4] = {45, -45, 135, -135};
    *pitch_deg = i < 16 ? (i % 2 ? 17 : -17) : i % 2 ? 72 : -72;
    *roll_deg = i < 16 ? rolls[i / 2] : diagonals[i / 2 % 4];
}

static void cross_edges(int reach, struct expected *e)
{
    struct rig rig;
    char text[160];
    snprintf(text, sizeof(text), "run_on=on far_share=0.5 reach_texels=%d", reach);
    open_plain(&rig, text);
    for (int i = 0; i < 2 * STANDS; i++) {
        const struct rule rule = {i % 2 == 1, reach, 0.15, 0.6, 0.5};
        double pitch_deg, roll_deg;
        stand(i / 2, &pitch_deg, &roll_deg);
        const double yaw_deg = 37 * (i % 5);
        snprintf(text, sizeof(text),
                 "pane_pitch_deg=%g pane_yaw_deg=%g pane_roll_deg=%g direction=%s", pitch_deg,
                 yaw_deg, roll_deg, rule.split ? "split" : "nearest");
        rig_set(&rig, text);
        struct box_oracle box;
        box_oracle_turn(&box, pitch_deg, yaw_deg, roll_deg);
        expect_step(&rig, &box, &rule, (uint32_t)(i + 100 * reach), e);
    }
    rig_close(&rig);
}

// Water takes all of the 24 ways over an edge. At each of them some falls off, too, where the pane
// beyond faces down too much.
static void expect_all_ways(const struct expected *e)
{
    for (int from = 0; from < BOX_PANES; from++) {
        for (int to = 0; to < BOX_PANES; to++) {
            const bool neighbours = from / 2 != to / 2;
            if ((e->crossings[from][to] > 0) != neighbours ||
                (e->falls[from][to] > 0) != neighbours)
                fail_msg("from pane %d to %d went %d parts, and %d fell", from, to,
                         e->crossings[from][to], e->falls[from][to]);
        }
    }
}

static void test_water_crosses_every_edge(void **state)
{
    (void)state;
    struct expected *e = calloc(1, sizeof(*e));
    for (int reach = 2; reach <= 4; reach++) {
        memset(e, 0, sizeof(*e));
        cross_edges(reach, e);
        expect_all_ways(e);
    }
    free(e);
}

// Kernels get the same frames of panes as the oracle.
static void test_panes_stand_as_documented(void **state)
{
    (void)state;
    struct flow_settings s;
    rg_params_reset(&flow_param_table, &s);
    for (int i = 0; i < STANDS; i++) {
        struct box_oracle box;
        stand(i, &s.pitch_deg, &s.roll_deg);
        s.yaw_deg = 31 * i - 180;
        box_oracle_turn(&box, s.pitch_deg, s.yaw_deg, s.roll_deg);
        for (int pane = 0; pane < BOX_PANES; pane++) {
            double axes[3][3];
            flow_pane_frame(&s, pane, 0, axes);
            for (int k = 0; k < 9; k++)
                if (fabs(axes[k / 3][k % 3] - box.frames[pane][k / 3][k % 3]) > 1e-12)
                    fail_msg("pane %d, axis %d", pane, k / 3);
        }
    }
}

// With run_on off, water ends at a pane's edge.
static void test_without_run_on_edges_drain(void **state)
{
    (void)state;
    struct rig rig;
    open_plain(&rig, "run_on=off pane_pitch_deg=17 pane_roll_deg=18");
    int64_t *water = calloc(TEXELS, sizeof(*water));
    water[rig_texel(&rig, BOX_TOP, 5, 0)] = UNIT / 2; // flows back and to the left
    water[rig_texel(&rig, BOX_FRONT, 9, SIZE - 1)] = UNIT / 2;
    rig_put(&rig, water);
    rig_step(&rig, 1);
    int64_t *after = rig_water(&rig);
    const int64_t stayed =
        after[rig_texel(&rig, BOX_TOP, 5, 0)] + after[rig_texel(&rig, BOX_FRONT, 9, SIZE - 1)];
    assert_int_equal(rig_sum(&rig), stayed);
    assert_int_equal(rig_ledger(&rig, FLOW_LEDGER_DRAINED), UNIT - stayed);
    assert_below(stayed, UNIT);
    free(water);
    free(after);
    rig_close(&rig);
}

// --- conservation ---

// With rain, edges and turns: at every step the water on the panes is what came less what left,
// modulo 2^32 as in the ledger.
static void balance(const char *assignments)
{
    char text[512];
    snprintf(text, sizeof(text),
             "view=box resolution_px=32 drops=200 rain_drops_s=900 drop_radius_max_mm=9 "
             "far_share=0.37 capacity=3 %s",
             assignments);
    struct rig rig;
    rig_open(&rig, device, text);
    for (int step = 0; step < 40; step++) {
        const uint32_t came = rig_ledger(&rig, FLOW_LEDGER_SOURCED);
        const uint32_t left = rig_ledger(&rig, FLOW_LEDGER_DRAINED);
        const int64_t sum = rig_sum(&rig);
        if ((uint32_t)sum != came - left)
            fail_msg("%s, step %d: the panes hold %lld droplets, %u came and %u left (modulo 2^32)",
                     assignments, step, (long long)sum, came, left);
        rig_step(&rig, 1);
    }
    assert_above(rig_ledger(&rig, FLOW_LEDGER_DRAINED), 0);
    rig_close(&rig);
}

static void test_water_is_conserved_on_the_box(void **state)
{
    (void)state;
    balance("run_on=off");
    balance("run_on=on");
    balance("run_on=off reach_texels=4 pane_pitch_deg=17 pane_roll_deg=18 direction=split");
    balance("run_on=on reach_texels=4 pane_pitch_deg=17 pane_roll_deg=18 direction=split");
    balance("run_on=on reach_texels=3 pane_pitch_deg=-72 pane_roll_deg=-135");
    // More rain than panes carry flows to the edge between two of them.
    balance("run_on=on reach_texels=4 pane_pitch_deg=20 pane_roll_deg=20 direction=split "
            "rain_drops_s=60000 drop_radius_max_mm=40 drop_height_per_mm=16 capacity=64 "
            "remainder_low=1 far_share=0.5 resolution_px=64");
    balance("run_on=on reach_texels=4 spin_roll_deg_s=400 spin_pitch_deg_s=250 direction=split");
}

// --- where it rests ---

// On level panes nothing moves, not even at edges, though it may run on.
static void test_water_rests_on_level_panes(void **state)
{
    (void)state;
    struct rig rig;
    open_plain(&rig, "run_on=on reach_texels=4 pane_yaw_deg=33 capacity=8");
    static const int at[5][2] = {{0, 0}, {SIZE - 1, 7}, {11, 0}, {3, SIZE - 1}, {12, 12}};
    int64_t *water = calloc(TEXELS, sizeof(*water));
    for (int i = 0; i < 5; i++)
        for (int pane = BOX_TOP; pane <= BOX_BOTTOM; pane++)
            water[rig_texel(&rig, pane, at[i][0], at[i][1])] = (1 + i) * UNIT;
    rig_put(&rig, water);
    rig_step(&rig, 6);
    int64_t *after = rig_water(&rig);
    assert_memory_equal(after, water, TEXELS * sizeof(*water));
    assert_int_equal(rig_ledger(&rig, FLOW_LEDGER_DRAINED), 0);
    free(water);
    free(after);
    rig_close(&rig);
}

int main(int argc, char **argv)
{
    device = argc > 1 ? argv[1] : device;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_panes_stand_as_documented),
        cmocka_unit_test(test_water_crosses_every_edge),
        cmocka_unit_test(test_without_run_on_edges_drain),
        cmocka_unit_test(test_water_is_conserved_on_the_box),
        cmocka_unit_test(test_water_rests_on_level_panes),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
