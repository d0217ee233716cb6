// Drops that are born on the model's pane and leave it: their numbers have the expected values, and
// masses balance.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <string.h>

#include "tests/oracle/drops/cases/rig.h"
#include "tests/oracle/drops/drops.h"
#include "tests/oracle/drops/particles.h"
#include "tests/tools/expect.h"

// A normal distribution lies below -1/3 with the probability 0.36944, and above 1/3 as often.
static void test_affinity(void **state)
{
    (void)state;
    enum { CELLS = 400 * 400 };
    struct oracle_drops_settings s = still(400, 400);
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    int none = 0, all = 0;
    for (int i = 0; i < CELLS; i++) {
        none += o.affinity[i] == 0;
        all += o.affinity[i] == 1;
        assert_at_least(o.affinity[i], 0);
        assert_at_most(o.affinity[i], 1);
    }
    const double bound = 4 * sqrt(0.36944 * (1 - 0.36944) / CELLS);
    assert_below(fabs((double)none / CELLS - 0.36944), bound);
    assert_below(fabs((double)all / CELLS - 0.36944), bound);
    oracle_drops_close(&o);
}

// The number of drops a step, their places and their masses.
static void test_generation(void **state)
{
    (void)state;
    enum { STEPS = 20000 };
    struct oracle_drops_settings s = still(120, 90);
    s.max_drops = 1 << 30;
    s.drops_a_step = 2.3;
    s.tilt_deg = 0; // all drops rest
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    for (int i = 0; i < STEPS; i++)
        oracle_drops_generate(&o);
    assert_below(fabs(o.count - 2.3 * STEPS), 4 * sqrt(STEPS * 0.3 * 0.7));
    double x = 0, y = 0, mass = 0, squares = 0;
    for (int i = 0; i < o.count; i++) {
        x += o.drops[i].x_mm / o.count;
        y += o.drops[i].y_mm / o.count;
        mass += o.drops[i].mass_mg / o.count;
        squares += pow(o.drops[i].mass_mg - 20.2, 2) / o.count;
    }
    assert_below(fabs(x - 30), 4 * 60 / sqrt(12.0 * o.count));
    assert_below(fabs(y - 22.5), 4 * 45 / sqrt(12.0 * o.count));
    assert_below(fabs(mass - 20.2), 4 * 1.5 / sqrt(o.count));
    assert_below(fabs(squares - 2.25), 4 * 2.25 * sqrt(2.0 / o.count));
    oracle_drops_close(&o);
}

// Expectation and variance of the number of residual drops of equation 6 in some steps. Each step's
// chance depends on the steps since the last drop.
static void residual_moments(double beta, int steps, double *mean, double *variance)
{
    enum { MOST = 64 };
    static double p[MOST][MOST], next[MOST][MOST]; // [steps since][drops]
    memset(p, 0, sizeof(p));
    p[0][0] = 1;
    for (int step = 0; step < steps; step++) {
        memset(next, 0, sizeof(next));
        for (int since = 0; since <= step; since++) {
            for (int drops = 0; drops <= step; drops++) {
                const double chance = fmin(1, beta / 6 * fmin(1, since / 6.0));
                next[0][drops + 1] += p[since][drops] * chance;
                next[since + 1][drops] += p[since][drops] * (1 - chance);
            }
        }
        memcpy(p, next, sizeof(p));
    }
    double squares = 0;
    *mean = 0;
    for (int since = 0; since < MOST; since++) {
        for (int drops = 0; drops < MOST; drops++) {
            *mean += drops * p[since][drops];
            squares += drops * drops * p[since][drops];
        }
    }
    *variance = squares - *mean * *mean;
}

// A second of drops that hardly move and hardly lose any mass. With the smaller beta, drops wait
// longer than tau_max.
static void test_residue(void **state)
{
    (void)state;
    enum { DROPS = 1000 };
    const double betas[] = {3, 0.6};
    for (int i = 0; i < 2; i++) {
        double mean, variance;
        residual_moments(betas[i], 60, &mean, &variance);
        struct oracle_drops_settings s = still(100, 100);
        s.residual = true;
        s.residual_beta = betas[i];
        s.max_drops = 1 << 30;
        s.residual_share_low = s.residual_share_high = 1e-6;
        struct oracle_drops o;
        oracle_drops_open(&o, &s);
        for (int d = 0; d < DROPS; d++)
            oracle_drops_add(&o, 25, 40, 20.02);
        for (int step = 0; step < 60; step++)
            oracle_drops_step(&o);
        assert_int_equal(o.ledger.residuals, o.count - DROPS);
        assert_int_equal(o.ledger.drained_drops, 0);
        assert_below(fabs(o.ledger.residuals - DROPS * mean), 4 * sqrt(DROPS * variance));
        oracle_drops_close(&o);
    }
}

// At max_drops no drop is born, and the parent keeps its mass.
static void test_limit(void **state)
{
    (void)state;
    struct oracle_drops_settings s = still(100, 100);
    s.residual = true;
    s.residual_beta = 1e3;
    s.max_drops = 1;
    struct oracle_drops o;
    oracle_drops_open(&o, &s);
    oracle_drops_add(&o, 25, 40, 21);
    oracle_drops_step(&o);
    assert_above(o.drops[0].tau_s, 0);
    oracle_drops_step(&o);
    assert_equals(o.drops[0].tau_s, 0);
    assert_equals(o.drops[0].mass_mg, 21);
    assert_equals(o.count, 1);
    oracle_drops_close(&o);
}

// With everything on, generated = on the pane + drained + deleted. No drop above the critical mass
// rests. IDs on the map are of drops that lived. Equal seeds give equal runs, others do not.
static void test_balance(void **state)
{
    (void)state;
    struct oracle_drops_settings s = oracle_drops_defaults();
    s.columns = 120;
    s.rows = 90;
    s.max_drops = 60;
    s.drops_a_step = 1.3;
    struct oracle_drops a, b, other;
    oracle_drops_open(&a, &s);
    oracle_drops_open(&b, &s);
    s.seed = 2;
    oracle_drops_open(&other, &s);
    for (int i = 0; i < 1000; i++) {
        oracle_drops_step(&a);
        oracle_drops_step(&b);
        oracle_drops_step(&other);
        if (i == 500)
            oracle_drops_delete(&a), oracle_drops_delete(&b);
        const struct oracle_drops_measures m = oracle_drops_measure(&a);
        const double kept = m.mass_mg + m.drained_mg + a.ledger.deleted_mg;
        assert_below(fabs(kept - a.ledger.generated_mg), 1e-12 * i * a.ledger.generated_mg + 1e-12);
        assert_at_most(m.drops, 60);
        for (int d = 0; d < a.count; d++)
            assert_true(!a.drops[d].is_static || a.drops[d].mass_mg <= 20);
        for (int c = 0; c < 120 * 90; c++)
            assert_true(a.id[c] < a.next_id && (a.id[c] == 0 || a.height_mm[c] > 0));
    }
    assert_above(a.ledger.merges, 20);
    assert_above(a.ledger.residuals, 20);
    assert_above(a.ledger.drained_drops, 20);
    assert_memory_equal(a.height_mm, b.height_mm, sizeof(double) * 120 * 90);
    assert_memory_equal(a.id, b.id, sizeof(uint32_t) * 120 * 90);
    assert_memory_not_equal(a.height_mm, other.height_mm, sizeof(double) * 120 * 90);
    oracle_drops_close(&a);
    oracle_drops_close(&b);
    oracle_drops_close(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_affinity), cmocka_unit_test(test_generation),
        cmocka_unit_test(test_residue),  cmocka_unit_test(test_limit),
        cmocka_unit_test(test_balance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
