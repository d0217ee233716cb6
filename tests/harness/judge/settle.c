// Whether claims hold by launches: closed cases of looks, confirmation and bounds.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "harness/judge/settle.h"
#include "tests/tools/expect.h"

enum { LAUNCHES = RG_SETTLE_LAUNCHES };

// Values about a median, with uniform noise that is not correlated.
static void fill(double *values, int from, int to, double median, double noise)
{
    uint32_t x = 7 + (uint32_t)from;
    for (int i = from; i < to; i++) {
        x = x * 1664525u + 1013904223u;
        values[i] = median + noise * ((x >> 8) * 0x1p-23 - 1);
    }
}

static struct rg_settling settle(const double *values, double least, double most, int launches)
{
    const struct rg_settle_part part = {values, least, most};
    return rg_settle(&rg_settle_rule, RG_SETTLE_ALL, &part, 1, launches);
}

static void looks_and_confirmation(void **state)
{
    (void)state;
    double values[LAUNCHES];
    fill(values, 0, LAUNCHES, 0.2, 0.01);
    assert_int_equal(settle(values, 0, INFINITY, 0).more, 12);
    assert_int_equal(settle(values, 0, INFINITY, 11).settled, RG_SETTLED_OPEN);
    assert_int_equal(settle(values, 0, INFINITY, 11).more, 1);
    assert_int_equal(settle(values, 0, INFINITY, 12).settled, RG_SETTLED_OPEN);
    assert_int_equal(settle(values, 0, INFINITY, 12).more, 12);
    const struct rg_settling s = settle(values, 0, INFINITY, 24);
    assert_int_equal(s.settled, RG_SETTLED_HOLDS);
    assert_int_equal(s.launches, 24);
    assert_int_equal(settle(values, 0.4, INFINITY, LAUNCHES).settled, RG_SETTLED_FAILS);
    assert_int_equal(settle(values, -INFINITY, 0.1, LAUNCHES).settled, RG_SETTLED_FAILS);
    assert_int_equal(settle(values, 0.1, 0.3, LAUNCHES).settled, RG_SETTLED_HOLDS);
    // The second half says the opposite, or nothing: the claim stays open.
    fill(values, 12, LAUNCHES, -0.2, 0.01);
    assert_int_equal(settle(values, 0, INFINITY, LAUNCHES).settled, RG_SETTLED_OPEN);
    assert_true(settle(values, 0, INFINITY, LAUNCHES).is_unconfirmed);
    assert_int_equal(settle(values, 0, INFINITY, LAUNCHES).more, 0);
    fill(values, 12, LAUNCHES, 0, 0.5);
    assert_int_equal(settle(values, 0, INFINITY, LAUNCHES).settled, RG_SETTLED_OPEN);
    assert_true(settle(values, 0, INFINITY, LAUNCHES).is_unconfirmed);
    assert_int_equal(settle(values, 0, INFINITY, LAUNCHES).launches, 12 + 96);
}

static void at_the_bound(void **state)
{
    (void)state;
    double values[LAUNCHES];
    fill(values, 0, LAUNCHES, 0, 0.03);
    const struct rg_settling s = settle(values, 0, INFINITY, LAUNCHES);
    assert_int_equal(s.settled, RG_SETTLED_AT_BOUND); // at once: no confirmation is needed
    assert_int_equal(s.launches, 12);
    fill(values, 0, LAUNCHES, 0, 0.2);
    assert_at_least(settle(values, 0, INFINITY, LAUNCHES).launches, 24); // 12 give more than 1.05
    // An interval beside the bound is not at it, however near.
    fill(values, 0, LAUNCHES, 0.02, 0.01);
    assert_int_equal(settle(values, 0, INFINITY, LAUNCHES).settled, RG_SETTLED_HOLDS);
}

static void several_parts(void **state)
{
    (void)state;
    double high[LAUNCHES], low[LAUNCHES], level[LAUNCHES];
    fill(high, 0, LAUNCHES, 0.2, 0.01);
    fill(low, 0, LAUNCHES, -0.2, 0.01);
    fill(level, 0, LAUNCHES, 0, 0.01);
    const struct rg_settle_part parts[] = {
        {high, 0, INFINITY}, {level, 0, INFINITY}, {low, 0, INFINITY}};
    int part;
    assert_int_equal(rg_settle(&rg_settle_rule, RG_SETTLE_ALL, parts, 2, LAUNCHES).settled,
                     RG_SETTLED_AT_BOUND);
    assert_int_equal(rg_settle(&rg_settle_rule, RG_SETTLE_ALL, parts, 3, LAUNCHES).settled,
                     RG_SETTLED_FAILS);
    assert_int_equal(rg_settle(&rg_settle_rule, RG_SETTLE_ALL, parts, 3, LAUNCHES).part, 2);
    assert_int_equal(rg_settle(&rg_settle_rule, RG_SETTLE_ANY, parts, 3, LAUNCHES).settled,
                     RG_SETTLED_HOLDS);
    assert_int_equal(rg_settle(&rg_settle_rule, RG_SETTLE_ANY, parts, 1, LAUNCHES).settled,
                     RG_SETTLED_FAILS);
    assert_int_equal(rg_settle_once(&rg_settle_rule, RG_SETTLE_ALL, parts, 3, &part),
                     RG_SETTLED_FAILS);
    assert_int_equal(part, 2);
    assert_int_equal(rg_settle_once(&rg_settle_rule, RG_SETTLE_ALL, parts, 2, &part),
                     RG_SETTLED_AT_BOUND);
    assert_int_equal(rg_settle_once(&rg_settle_rule, RG_SETTLE_ALL, parts, 1, &part),
                     RG_SETTLED_HOLDS);
}

// The wider values scatter, the more launches a verdict needs.
static void launches_needed(void **state)
{
    (void)state;
    double values[LAUNCHES];
    int before = 0;
    for (int i = 1; i <= 3; i++) {
        fill(values, 0, LAUNCHES, 0.05, 0.2 * i);
        const struct rg_settling s = settle(values, 0, INFINITY, 11);
        assert_int_equal(s.settled, RG_SETTLED_OPEN);
        assert_above(s.needed, before);
        before = s.needed;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looks_and_confirmation),
        cmocka_unit_test(at_the_bound),
        cmocka_unit_test(several_parts),
        cmocka_unit_test(launches_needed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
