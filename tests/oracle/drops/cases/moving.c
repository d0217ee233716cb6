// Drops of the model run and rest, in cases that the paper's equations decide.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "tests/oracle/drops/cases/rig.h"
#include "tests/oracle/drops/drops.h"
#include "tests/oracle/drops/map.h"
#include "tests/tools/expect.h"

static const double GRAVITY_MM_S2 = 9800;

// Equations 2 to 5: after n substeps v = n a h, and the distance is a h^2 n (n + 1) / 2.
static void test_fall(void **state)
{
    (void)state;
    const double tilts[] = {90, 60};
    for (int t = 0; t < 2; t++) {
        struct oracle_drops_settings s = quiet(61, 400);
        s.tilt_deg = tilts[t];
        struct oracle_drops o;
        oracle_drops_open(&o, &s);
        even_affinity(&o);
        const double x = 15.25, y = 190, mass = 45;
        oracle_drops_add(&o, x, y, mass);
        const double a = GRAVITY_MM_S2 * (t ? sqrt(0.75) : 1) - 20 * GRAVITY_MM_S2 / mass;
        const double h = 1.0 / 240;
        for (int n = 4; n <= 32; n += 4) {
            oracle_drops_step(&o);
            const struct oracle_drop *drop = &o.drops[0];
            assert_false(drop->is_static);
            assert_below(fabs(drop->vy_mm_s + n * a * h), 1e-9);
            assert_below(fabs(drop->y_mm - (y - a * h * h * n * (n + 1) / 2)), 1e-9);
            assert_equals(drop->x_mm, x);
            assert_equals(drop->vx_mm_s, 0);
            assert_below(fabs(o.ledger.trail_mm - (y - drop->y_mm)), 1e-9);
        }
        oracle_drops_close(&o);
    }
}

// A drop with m sin(tilt) <= m_c rests; on a steeper pane it would run.
static void test_rest(void **state)
{
    (void)state;
    struct oracle_drops_settings s = quiet(61, 100);
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    oracle_drops_add(&o, 10, 40, 20);
    oracle_drops_add(&o, 20, 40, 20.001);
    o.settings.tilt_deg = 80;
    for (int i = 0; i < 50; i++)
        oracle_drops_step(&o);
    assert_equals(o.drops[0].y_mm, 40);
    assert_equals(o.drops[1].y_mm, 40);
    assert_equals(o.ledger.trail_mm, 0);
    o.settings.tilt_deg = 90;
    oracle_drops_step(&o);
    assert_true(o.drops[0].is_static);
    assert_equals(o.drops[0].y_mm, 40);
    assert_true(!o.drops[1].is_static);
    assert_below(o.drops[1].y_mm, 40);
    // A drop that has become too light stops at its place.
    const double y = o.drops[1].y_mm;
    o.drops[1].mass_mg = 19;
    oracle_drops_step(&o);
    assert_equals(o.drops[1].y_mm, y);
    assert_equals(o.drops[1].vy_mm_s, 0);
    assert_true(o.drops[1].is_static);
    oracle_drops_close(&o);
}

// Water ahead draws a drop, more strongly than affinity. Without water, affinity does. With equal
// sides the drop runs south.
static void test_direction(void **state)
{
    (void)state;
    for (int side = -1; side <= 1; side++) {
        for (int wet = 0; wet <= 1; wet++) {
            struct oracle_drops_settings s = still(41, 61);
            s.substeps = 1;
            struct oracle_drops o;
            oracle_drops_open(&o, &s);
            even_affinity(&o);
            const int row = 20, column = 20;
            oracle_drops_add(&o, (column + 0.5) * 0.5, (61 - row - 0.5) * 0.5, 30);
            // The region's outermost cell counts; the one beyond it does not.
            double *map = wet ? o.height_mm : o.affinity;
            if (side)
                map[(row + 4) * 41 + column + 3 * side] += 0.4;
            map[(row + 4) * 41 + column + 4] += wet ? 0 : 0.5;
            if (wet)
                o.affinity[(row + 3) * 41 + column - 2 * side] = 1;
            oracle_drops_find_wet(&o);
            oracle_drops_step(&o);
            const double slope = o.drops[0].vx_mm_s / -o.drops[0].vy_mm_s;
            assert_below(fabs(slope - side * 2.0 / 3), 1e-12);
            oracle_drops_close(&o);
        }
    }
}

// The angle to the south is U(-0.3, 0.3): the test checks its mean and its variance.
static void test_meander(void **state)
{
    (void)state;
    enum { DROPS = 4000 };
    struct oracle_drops_settings s = still(2000, 40);
    s.substeps = 1;
    s.meander_rad = 0.3;
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    even_affinity(&o);
    double sum = 0, squares = 0;
    for (int i = 0; i < DROPS; i++) {
        oracle_drops_add(&o, 500, 15, 21);
        memset(o.height_mm, 0, sizeof(*o.height_mm) * 2000 * 40);
        oracle_drops_step(&o);
        const double angle = atan2(o.drops[0].vx_mm_s, -o.drops[0].vy_mm_s);
        assert_at_most(fabs(angle), 0.3);
        sum += angle;
        squares += angle * angle;
        oracle_drops_delete(&o);
    }
    const double variance = 0.3 * 0.3 / 3;
    assert_below(fabs(sum / DROPS), 4 * sqrt(variance / DROPS));
    // The square of a uniform number has a variance of 4/45 of its greatest value's square.
    assert_below(fabs(squares / DROPS - variance), 4 * sqrt(4.0 / 45 / DROPS) * 0.09);
    oracle_drops_close(&o);
}

// A drop that runs far in a step leaves no gap with trails on.
static void test_trail(void **state)
{
    (void)state;
    for (int trail = 0; trail <= 1; trail++) {
        struct oracle_drops_settings s = still(41, 1200);
        s.critical_mass_mg = 1;
        s.trail = trail;
        struct oracle_drops o;
        oracle_drops_open(&o, &s);
        even_affinity(&o);
        oracle_drops_add(&o, 10.25, 598, 2);
        while (o.drops[0].y_mm > 50)
            oracle_drops_step(&o);
        int dry = 0;
        const int row = oracle_drops_cell_at(&o, 10.25, o.drops[0].y_mm).row;
        for (int i = 10; i < row; i++)
            dry += o.height_mm[i * 41 + 20] == 0;
        assert_true(trail ? dry == 0 : dry > 100);
        oracle_drops_close(&o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fall),      cmocka_unit_test(test_rest),
        cmocka_unit_test(test_direction), cmocka_unit_test(test_meander),
        cmocka_unit_test(test_trail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
