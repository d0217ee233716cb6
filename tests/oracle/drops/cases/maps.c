// The maps of the model: hemispheres, smoothing, spreading IDs and erosion.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "tests/oracle/drops/cases/rig.h"
#include "tests/oracle/drops/drops.h"
#include "tests/oracle/drops/map.h"
#include "tests/tools/expect.h"

static void test_hemisphere(void **state)
{
    (void)state;
    struct oracle_drops_settings s = still(400, 300);
    s.cell_mm = 0.05;
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    const double radius = 3, mass = 2.0 / 3 * M_PI * radius * radius * radius;
    oracle_drops_place(&o, 7, 10.013, 7.021, mass);
    assert_below(fabs(water(&o) * 0.05 * 0.05 / mass - 1), 1e-3);
    assert_below(fabs(owned(&o, 7) * 0.05 * 0.05 / (M_PI * radius * radius) - 1), 5e-3);
    // A smaller hemisphere inside changes nothing; of two overlapping ones the higher counts.
    const double before = water(&o);
    oracle_drops_place(&o, 8, 10.013, 7.021, mass / 2);
    assert_equals(water(&o), before);
    assert_equals(owned(&o, 8), 0);
    oracle_drops_place(&o, 9, 13.013, 7.021, mass);
    assert_int_equal(owner(&o, 11.4, 7), 7);
    assert_int_equal(owner(&o, 11.6, 7), 9);
    oracle_drops_close(&o);
}

// One smoothed cell becomes nine ninths. No water is lost while every cell is above the threshold,
// even at the edges; below it the cell dries.
static void test_smoothing(void **state)
{
    (void)state;
    struct oracle_drops_settings s = still(12, 9);
    s.smooth = true;
    s.erode_threshold_mm = 0;
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    o.height_mm[4 * 12 + 5] = 9;
    oracle_drops_find_wet(&o);
    oracle_drops_step(&o);
    for (int i = 0; i < 9; i++)
        for (int j = 0; j < 12; j++)
            assert_equals(o.height_mm[i * 12 + j], (abs(i - 4) <= 1 && abs(j - 5) <= 1));
    for (int i = 0; i < 1500; i++)
        oracle_drops_step(&o);
    assert_below(fabs(water(&o) - 9), 1e-11);
    assert_below(fabs(o.height_mm[0] - 9.0 / (9 * 12)), 1e-9);
    o.settings.erode_threshold_mm = 0.1;
    oracle_drops_step(&o);
    assert_equals(water(&o), 0);
    oracle_drops_close(&o);
}

// IDs spread by one cell each way and a corner, if the water is deep enough.
static void test_ids_spread(void **state)
{
    (void)state;
    struct oracle_drops_settings s = still(12, 9);
    s.smooth = true;
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    for (int i = 0; i < 12 * 9; i++)
        o.height_mm[i] = i % 12 < 6 ? 2 : 0.4;
    o.next_id = 6;
    o.id[4 * 12 + 3] = 5;
    oracle_drops_find_wet(&o);
    oracle_drops_smooth(&o);
    // Pass A fills above and left of a cell, pass B then below and right of all those, with the
    // corners.
    const int rows[7][2] = {{3, 3}, {4, 2}, {4, 3}, {3, 4}, {5, 2}, {5, 3}, {4, 4}};
    for (int i = 0; i < 7; i++)
        assert_int_equal(o.id[rows[i][0] * 12 + rows[i][1]], 5);
    assert_int_equal(owned(&o, 5), 7);
    for (int i = 0; i < 3; i++)
        oracle_drops_smooth(&o);
    for (int i = 0; i < 12 * 9; i++)
        assert_true(o.id[i] == 0 || o.height_mm[i] >= 0.5);
    assert_above(owned(&o, 5), 20);
    oracle_drops_close(&o);
}

// A run of k cells is gone after ceil(k / 2) steps, no sooner. At an edge of the pane it loses one
// side only.
static void test_erosion(void **state)
{
    (void)state;
    for (int k = 1; k <= 9; k++) {
        const int begins[] = {5, 0, 20 - k};
        for (int edge = 0; edge < 3; edge++) {
            struct oracle_drops_settings s = still(20, 3);
            s.erode = true;
            struct oracle_drops o;
            oracle_drops_open(&o, &s);
            for (int j = begins[edge]; j < begins[edge] + k; j++)
                o.height_mm[20 + j] = 1, o.id[20 + j] = 1;
            oracle_drops_find_wet(&o);
            const int steps = edge ? k : (k + 1) / 2;
            for (int i = 0; i < steps; i++) {
                const int left = edge ? k - i : k - 2 * i;
                assert_equals(water(&o), left);
                assert_equals(owned(&o, 1), left);
                oracle_drops_step(&o);
            }
            assert_equals(water(&o), 0);
            assert_equals(owned(&o, 0), 60);
            oracle_drops_close(&o);
        }
    }
}

// Without drops, water shrinks and vanishes, and so do its IDs.
static void test_deletion(void **state)
{
    (void)state;
    struct oracle_drops_settings s = oracle_drops_defaults();
    s.columns = 160;
    s.rows = 100;
    s.drops_a_step = 0.01; // a pane wetter than the paper's takes longer to dry
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    for (int i = 0; i < 600; i++)
        oracle_drops_step(&o);
    assert_above(oracle_drops_measure(&o).wet_cells, 500);
    o.settings.drops_a_step = 0;
    oracle_drops_delete(&o);
    double before = water(&o);
    for (int i = 0; i < 1000 && before > 0; i++) {
        oracle_drops_step(&o);
        const double now = water(&o);
        assert_below(now, before + 1e-9);
        before = now;
    }
    assert_int_equal(oracle_drops_measure(&o).wet_cells, 0);
    assert_int_equal(owned(&o, 0), 160 * 100);
    assert_equals(o.count, 0);
    assert_above(o.ledger.deleted_mg, 0);
    oracle_drops_close(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hemisphere), cmocka_unit_test(test_smoothing),
        cmocka_unit_test(test_ids_spread), cmocka_unit_test(test_erosion),
        cmocka_unit_test(test_deletion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
