// drops obeys its laws, and in closed cases the paper's equations.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/drops/rig.h"
#include "tests/tools/expect.h"

#define PANE  "columns=200 rows=160 drops_s=0 meander_rad=0 "
#define RAINY "columns=250 rows=150 drops_s=30 max_drops=300 "

static struct rg_device *device;

static drops_drop drop(double mg, double x_mm, double y_mm)
{
    return (drops_drop){
        .mass = (uint32_t)(mg * DROPS_QUANTA_MG), .x = (float)x_mm, .y = (float)y_mm};
}

static struct drops *open_with(const char *settings, const drops_drop *all, int count)
{
    struct drops *d = rig_open(device, settings);
    struct rg_buf *affinity = rg_asset_find(&d->base, "affinity")->buf;
    float *even = malloc(affinity->size);
    assert_non_null(even);
    for (size_t i = 0; i < affinity->size / sizeof(*even); i++)
        even[i] = 0.5f;
    assert_true(rg_buf_write(affinity, 0, even, (int64_t)affinity->size));
    free(even);
    rig_put(d, all, count, 1);
    return d;
}

static void expect_near(double found, double due, double share)
{
    if (!(fabs(found - due) <= share * fabs(due)))
        fail_msg("%.9g is not %.9g", found, due);
}

// --- motion ---

// Eqs. 2 to 5: each substep adds a dt to the speed, and the place follows the speed.
static void a_drop_falls_as_the_equations_say(void **state)
{
    (void)state;
    static const struct {
        const char *settings;
        double mg, along; // the part of gravity
    } cases[] = {{PANE "residual=off", 50, 1},
                 {PANE "residual=off substeps=2 step_s=0.02", 30, 1},
                 {PANE "residual=off tilt_deg=30", 60, 0.5}};
    for (int c = 0; c < 3; c++) {
        const drops_drop one = drop(cases[c].mg, 50.2, 5.1);
        struct drops *d = open_with(cases[c].settings, &one, 1);
        const double dt = d->settings.step_s / d->settings.substeps;
        const double a = 9800 * (cases[c].along - 20 / cases[c].mg);
        const int steps = 8, n = steps * d->settings.substeps;
        int count;
        rig_step(d, steps);
        drops_drop *all = rig_drops(d, &count);
        assert_int_equal(count, 1);
        expect_near((double)all[0].vy, a * dt * n, 1e-5);
        expect_near((double)all[0].y - 5.1, a * dt * dt * n * (n + 1) / 2, 1e-4);
        expect_near((double)all[0].x, 50.2, 1e-6);
        free(all);
        rig_close(d);
    }
}

// A pane holds drops up to the critical mass, and a tilted pane heavier ones.
static void light_drops_stay(void **state)
{
    (void)state;
    static const char *const settings[] = {PANE, PANE "tilt_deg=30", PANE "tilt_deg=0"};
    const double most[] = {20, 40, 5000};
    for (int c = 0; c < 3; c++) {
        const drops_drop both[] = {drop(most[c], 30, 20), drop(most[c] * 1.01, 70, 20)};
        struct drops *d = open_with(settings[c], both, 2);
        int count;
        rig_step(d, 3);
        drops_drop *all = rig_drops(d, &count);
        assert_equals(all[0].x, 30);
        assert_equals(all[0].y, 20);
        assert_equals((all[1].y > 20), (c < 2));
        free(all);
        rig_close(d);
    }
}

// On a pane turned upside down in its plane drops run the other way; on its side, sideways.
static void drops_run_down_however_the_pane_is_turned(void **state)
{
    (void)state;
    static const char *const turns[] = {PANE "residual=off", PANE "residual=off turn_deg=180",
                                        PANE "residual=off turn_deg=90",
                                        PANE "residual=off turn_deg=-90"};
    const double down[][2] = {{0, 1}, {0, -1}, {-1, 0}, {1, 0}};
    for (int c = 0; c < 4; c++) {
        const drops_drop one = drop(50, 50.25, 40.25);
        struct drops *d = open_with(turns[c], &one, 1);
        const double dt = d->settings.step_s / 4, way = 5880 * dt * dt * 20 * 21 / 2;
        int count;
        rig_step(d, 5);
        drops_drop *all = rig_drops(d, &count);
        expect_near((double)all[0].x, 50.25 + down[c][0] * way, 1e-4);
        expect_near((double)all[0].y, 40.25 + down[c][1] * way, 1e-4);
        free(all);
        rig_close(d);
    }
}

// --- water ---

// The hemisphere of eq. 7 has the drop's volume, 2/3 pi r^3.
static void water_is_as_much_as_the_drop(void **state)
{
    (void)state;
    for (int lines = 0; lines < 2; lines++) {
        const drops_drop one = drop(90, 50.1, 40.2);
        struct drops *d =
            open_with(lines ? PANE "critical_mass_mg=100 smooth=off erode=off trail=lines"
                            : PANE "critical_mass_mg=100 smooth=off erode=off",
                      &one, 1);
        rig_step(d, 1);
        float *height = rig_words(d, "height");
        double volume = 0;
        for (int64_t i = 0; i < (int64_t)rg_asset_find(&d->base, "height")->buf->size / 4; i++)
            volume += (double)height[i] * 0.25;
        expect_near(volume, 90, 0.02);
        free(height);
        rig_close(d);
    }
}

// To the last quantum, water that landed is on the pane, has left it or was removed. Every ID on
// the map was a drop's, and no drop above the critical mass stands still.
static void rain_obeys_its_laws(void **state)
{
    (void)state;
    static const char *const settings[] = {RAINY, RAINY "seed=2 turn_deg=180 trail=lines",
                                           RAINY "seed=3 erode=off", RAINY "seed=4 merge=off",
                                           RAINY "seed=5 residual=off tilt_deg=60",
                                           RAINY "seed=6 smooth=off remove_s=2",
                                           // A step moves a drop farther than the pane's length.
                                           RAINY "seed=7 rows=16 columns=400 step_s=0.1"};
    for (int c = 0; c < 7; c++) {
        struct drops *d = rig_open(device, settings[c]);
        for (int round = 0; round < 4; round++) {
            rig_step(d, 50);
            int count;
            drops_drop *all = rig_drops(d, &count);
            uint32_t mass = 0, id = 0;
            for (int i = 0; i < count; i++) {
                mass += all[i].mass;
                assert_above(all[i].id, id);
                assert_above(all[i].mass, 0);
                id = all[i].id;
                if (all[i].mass > d->params.critical && !all[i].is_new)
                    assert_true(all[i].vx != 0 || all[i].vy != 0);
            }
            assert_int_equal(rig_tally(d, DROPS_SOURCED),
                             mass + rig_tally(d, DROPS_DRAINED) + rig_tally(d, DROPS_REMOVED));
            uint32_t *ids = rig_words(d, "ids");
            for (int64_t i = 0; i < (int64_t)rg_asset_find(&d->base, "ids")->buf->size / 4; i++)
                assert_below(ids[i], rig_tally(d, DROPS_NEXT_ID));
            free(ids);
            free(all);
        }
        assert_above(rig_tally(d, DROPS_LANDED), 40);
        assert_equals((rig_tally(d, DROPS_BORN) > 0), (c != 4));
        assert_equals((rig_tally(d, DROPS_MERGED) > 0), (c != 3));
        assert_equals((rig_tally(d, DROPS_REMOVED) > 0), (c == 5));
        rig_close(d);
    }
}

// Skipping work where nothing changes alters no bit.
static void sleep_changes_no_bit(void **state)
{
    (void)state;
    static const char *const names[] = {"height", "ids", "drops"};
    struct drops *a = rig_open(device, RAINY "drops_s=8 remove_s=4 seed=7");
    struct drops *b = rig_open(device, RAINY "drops_s=8 remove_s=4 seed=7 sleep=off");
    for (int round = 0; round < 6; round++) {
        rig_step(a, 50);
        rig_step(b, 50);
        for (int i = 0; i < 3; i++) {
            void *words = rig_words(a, names[i]), *due = rig_words(b, names[i]);
            const size_t bytes = i == 2 ? rig_tally(a, DROPS_COUNT) * sizeof(drops_drop)
                                        : rg_asset_find(&a->base, names[i])->buf->size;
            if (memcmp(words, due, bytes))
                fail_msg("%s differ after %d steps", names[i], 50 * (round + 1));
            free(words);
            free(due);
        }
    }
    assert_below(a->base.counters[DROPS_CELLS].value, b->base.counters[DROPS_CELLS].value / 2);
    rig_close(a);
    rig_close(b);
}

// The height map converges once nothing moves. Without drops all water vanishes.
static void water_comes_to_rest_and_vanishes(void **state)
{
    (void)state;
    const drops_drop all[] = {drop(18, 20.2, 20), drop(5, 60, 30.1), drop(10, 62.5, 32)};
    struct drops *d = open_with(PANE "remove_s=10", all, 3);
    rig_step(d, 598);
    const uint32_t tiles = rig_tally(d, DROPS_TILES);
    rig_step(d, 1);
    assert_int_equal(rig_tally(d, DROPS_TILES), tiles);
    rig_step(d, 200);
    float *height = rig_words(d, "height");
    for (int64_t i = 0; i < (int64_t)rg_asset_find(&d->base, "height")->buf->size / 4; i++)
        assert_equals(height[i], 0);
    assert_int_equal(rig_tally(d, DROPS_COUNT), 0);
    free(height);
    rig_close(d);
}

// --- merging ---

// Drops whose waters meet become one: it has their mass and momentum, at the place of the lowest.
static void expect_merged(uint32_t first_id)
{
    const drops_drop all[] = {drop(10, 50, 30), drop(15, 52.4, 31), drop(12, 54.5, 30.5),
                              drop(8, 80, 60)};
    struct drops *d = open_with(PANE "critical_mass_mg=100", all, 4);
    rig_put(d, all, 4, first_id);
    rig_step(d, 2);
    int count;
    drops_drop *left = rig_drops(d, &count);
    assert_int_equal(count, 2);
    assert_int_equal(left[0].id, first_id + 3);
    assert_int_equal(left[1].id, first_id + 4);
    assert_int_equal(left[1].mass, 37 * (int)DROPS_QUANTA_MG);
    assert_equals(left[1].x, (float)52.4);
    assert_equals(left[1].y, 31);
    uint32_t *ids = rig_words(d, "ids");
    for (int k = 0; k < 3; k++)
        assert_int_equal(ids[drops_cell(d->params, (int)(all[k].x / 0.5f), (int)(all[k].y / 0.5f))],
                         first_id + 4);
    free(ids);
    free(left);
    rig_close(d);
}

static void waters_that_meet_merge(void **state)
{
    (void)state;
    expect_merged(1);
}

// After many drops, IDs are far beyond the bits of the set of hot ones, and share them.
static void waters_of_late_drops_merge(void **state)
{
    (void)state;
    expect_merged(1u << 28);
}

// The waters of two drops are equally high in cells halfway between: the older drop owns these.
static void the_oldest_owns_what_is_as_high(void **state)
{
    (void)state;
    const drops_drop both[] = {drop(18, 52.25, 30.25), drop(18, 50.25, 30.25)};
    struct drops *d = open_with(PANE "merge=off smooth=off erode=off", both, 2);
    rig_step(d, 1);
    uint32_t *ids = rig_words(d, "ids");
    for (int row = 58; row <= 62; row++) {
        assert_int_equal(ids[drops_cell(d->params, 101, row)], 2);
        assert_int_equal(ids[drops_cell(d->params, 102, row)], 1);
        assert_int_equal(ids[drops_cell(d->params, 103, row)], 1);
    }
    free(ids);
    rig_close(d);
}

// A drop that runs into one at rest keeps their momentum.
static void momentum_is_kept(void **state)
{
    (void)state;
    const drops_drop both[] = {drop(40, 50.25, 20), drop(15, 50.25, 26)};
    struct drops *d = open_with(PANE "residual=off", both, 2);
    int count = 2;
    drops_drop before = {0}, *all = NULL;
    for (int i = 0; i < 20 && count == 2; i++) {
        if (all)
            before = all[0];
        free(all);
        rig_step(d, 1);
        all = rig_drops(d, &count);
    }
    assert_int_equal(count, 1);
    const double dt = d->settings.step_s, speed = (double)before.vy + 4900 * dt;
    expect_near((double)all[0].vy, speed * 40 / 55, 1e-3);
    free(all);
    rig_close(d);
}

static void only_beads_have_a_map_of_what_glass_holds(void **state)
{
    (void)state;
    static const char *const trails[] = {PANE "trail=hemispheres", PANE "trail=lines",
                                         PANE "trail=beads"};
    for (int i = 0; i < 3; i++) {
        struct drops *d = rig_open(device, trails[i]);
        assert_int_equal(rg_asset_find(&d->base, "held") != NULL, i == 2);
        rig_close(d);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_drop_falls_as_the_equations_say),
        cmocka_unit_test(light_drops_stay),
        cmocka_unit_test(drops_run_down_however_the_pane_is_turned),
        cmocka_unit_test(water_is_as_much_as_the_drop),
        cmocka_unit_test(rain_obeys_its_laws),
        cmocka_unit_test(sleep_changes_no_bit),
        cmocka_unit_test(water_comes_to_rest_and_vanishes),
        cmocka_unit_test(waters_that_meet_merge),
        cmocka_unit_test(waters_of_late_drops_merge),
        cmocka_unit_test(the_oldest_owns_what_is_as_high),
        cmocka_unit_test(momentum_is_kept),
        cmocka_unit_test(only_beads_have_a_map_of_what_glass_holds),
    };
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
