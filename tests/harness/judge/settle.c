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

// --- bounds ---

// A rule with one look, at 12 launches. Its interval is from the second smallest to the second
// largest: by the binomial distribution P(X < 2) is 13 / 4096, P(X < 3) 79 / 4096.
static const struct rg_settle_rule one_look = {
    .error = 0.01, .near = 0.05, .look_count = 1, .looks = {12}};

// Launches in turn at either end of this interval.
static void fill_between(double *values, double low, double high)
{
    for (int i = 0; i < LAUNCHES; i++)
        values[i] = i % 2 ? high : low;
}

static void bounds_have_two_sides(void **state)
{
    (void)state;
    static const struct {
        double low, high, least, most;
        enum rg_settled settled;
    } cases[] = {
        {0.1, 0.2, 0, INFINITY, RG_SETTLED_HOLDS},
        {-0.2, -0.1, 0, INFINITY, RG_SETTLED_FAILS},
        {-0.04, 0.04, 0, INFINITY, RG_SETTLED_AT_BOUND},
        {-0.05, 0.05, 0, INFINITY, RG_SETTLED_AT_BOUND},
        {0, 0.04, 0, INFINITY, RG_SETTLED_AT_BOUND},
        {-0.04, 0, 0, INFINITY, RG_SETTLED_AT_BOUND},
        {-0.04, 0.2, 0, INFINITY, RG_SETTLED_OPEN},
        {-0.2, 0.04, 0, INFINITY, RG_SETTLED_OPEN},
        {-0.2, -0.1, -INFINITY, 0, RG_SETTLED_HOLDS},
        {0.1, 0.2, -INFINITY, 0, RG_SETTLED_FAILS},
        {-0.04, 0.04, -INFINITY, 0, RG_SETTLED_AT_BOUND},
        {-0.04, 0.2, -INFINITY, 0, RG_SETTLED_OPEN},
        {-0.2, 0.04, -INFINITY, 0, RG_SETTLED_OPEN},
        {0.1, 0.9, 0, 1, RG_SETTLED_HOLDS},
        {0.97, 1.04, 0, 1, RG_SETTLED_AT_BOUND},
        {-0.04, 0.9, 0, 1, RG_SETTLED_OPEN},
        {0.1, 1.04, 0, 1, RG_SETTLED_OPEN},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        double values[LAUNCHES];
        fill_between(values, cases[i].low, cases[i].high);
        const struct rg_settle_part part = {values, cases[i].least, cases[i].most};
        const struct rg_settling s = rg_settle(&one_look, RG_SETTLE_ALL, &part, 1, 24);
        if (s.settled != cases[i].settled)
            fail_msg("%g to %g: %d", cases[i].low, cases[i].high, s.settled);
        assert_equals(s.of.low, cases[i].low);
        assert_equals(s.of.high, cases[i].high);
    }
}

// One launch, without an interval: at a bound is what is within `near` of it, on either side.
static void a_single_launch_has_bounds(void **state)
{
    (void)state;
    static const struct {
        double value, least, most;
        enum rg_settled all, any;
    } cases[] = {
        {0.1, 0, INFINITY, RG_SETTLED_HOLDS, RG_SETTLED_FAILS},
        {-0.1, 0, INFINITY, RG_SETTLED_FAILS, RG_SETTLED_HOLDS},
        {0.05, 0, INFINITY, RG_SETTLED_AT_BOUND, RG_SETTLED_AT_BOUND},
        {-0.05, 0, INFINITY, RG_SETTLED_AT_BOUND, RG_SETTLED_AT_BOUND},
        {0.1, -INFINITY, 0, RG_SETTLED_FAILS, RG_SETTLED_HOLDS},
        {-0.1, -INFINITY, 0, RG_SETTLED_HOLDS, RG_SETTLED_FAILS},
        {0.5, 0, 1, RG_SETTLED_HOLDS, RG_SETTLED_FAILS},
        {0.98, 0, 1, RG_SETTLED_AT_BOUND, RG_SETTLED_AT_BOUND},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const double inside[] = {7};
        const struct rg_settle_part parts[] = {{inside, 0, INFINITY},
                                               {&cases[i].value, cases[i].least, cases[i].most}};
        int part;
        assert_int_equal(rg_settle_once(&one_look, RG_SETTLE_ALL, parts, 2, &part), cases[i].all);
        assert_int_equal(part, 1);
        assert_int_equal(rg_settle_once(&one_look, RG_SETTLE_ANY, parts, 2, &part), cases[i].any);
    }
}

// Of parts with equal verdicts the one decides that lies least inside of its bounds; an open part
// decides before one at the bound, however far it lies inside.
static void the_part_that_decides_is_named(void **state)
{
    (void)state;
    double deep[LAUNCHES], shallow[LAUNCHES], level[LAUNCHES], open[LAUNCHES];
    fill_between(deep, 0.5, 0.6);
    fill_between(shallow, 0.2, 0.3);
    fill_between(level, -0.04, 0.02);
    fill_between(open, -0.2, 0.5);
    const double *const pairs[][2] = {
        {shallow, deep}, {deep, shallow}, {open, level}, {level, open}, {level, deep}};
    static const struct {
        enum rg_settled settled;
        int part;
        double median;
    } due[] = {{RG_SETTLED_HOLDS, 0, 0.25},
               {RG_SETTLED_HOLDS, 1, 0.25},
               {RG_SETTLED_OPEN, 0, 0.15},
               {RG_SETTLED_OPEN, 1, 0.15},
               {RG_SETTLED_AT_BOUND, 0, -0.01}};
    for (int i = 0; i < 5; i++) {
        const struct rg_settle_part parts[] = {{pairs[i][0], 0, INFINITY},
                                               {pairs[i][1], 0, INFINITY}};
        const struct rg_settling s = rg_settle(&one_look, RG_SETTLE_ALL, parts, 2, 24);
        assert_int_equal(s.settled, due[i].settled);
        assert_int_equal(s.part, due[i].part);
        assert_near(s.of.median, due[i].median, 1e-9);
    }
}

// Any of the parts may be the one that fails, so they share the error of that: of five parts,
// 0.00125 / 5 is above the 1 / 4096 of 12 launches on one side; of six it is below, and it takes 24
// launches, and 24 more to confirm it.
static void parts_share_the_error_of_failing(void **state)
{
    (void)state;
    double low[LAUNCHES], high[LAUNCHES];
    fill_between(low, -0.3, -0.2);
    fill_between(high, 0.2, 0.3);
    struct rg_settle_part parts[6] = {{low, 0, INFINITY}};
    for (int i = 1; i < 6; i++)
        parts[i] = (struct rg_settle_part){high, 0, INFINITY};
    const struct rg_settle_rule *rule = &rg_settle_rule;
    assert_int_equal(rg_settle(rule, RG_SETTLE_ALL, parts, 5, 24).settled, RG_SETTLED_FAILS);
    assert_int_equal(rg_settle(rule, RG_SETTLE_ALL, parts, 6, 47).settled, RG_SETTLED_OPEN);
    assert_int_equal(rg_settle(rule, RG_SETTLE_ALL, parts, 6, 48).settled, RG_SETTLED_FAILS);
}

// --- launches ---

static void the_rule_is_the_promised_one(void **state)
{
    (void)state;
    assert_equals(rg_settle_rule.error, 0.01);
    assert_near(rg_settle_rule.near, log(1.05), 1e-15);
    assert_int_equal(rg_settle_rule.look_count, 4);
    for (int i = 0; i < 4; i++)
        assert_int_equal(rg_settle_rule.looks[i], 12 << i);
}

// A median's error is 1.2533 times that of a mean, and the spread 1.4826 times the distance of half
// of the values. The interval must be 3.0233 errors off the bound, and 1.6449 more show it in 95 of
// 100 cases; half of `near` is the least distance. The launches are doubled from 12 on until they
// suffice, and doubled for the confirmation, before the first look as well.
static void launches_needed_follow_from_the_spread(void **state)
{
    (void)state;
    static const struct {
        double median, swing;
        int needed;
    } cases[] = {{0.05, 0.2, 2 * 1536}, // 1204
                 {0.1, 0.2, 2 * 384},   // 301
                 {-0.1, 0.2, 2 * 384},  // 301
                 {0.01, 0.2, 2 * 3072}, // 2000
                 {0.2, 0.21, 2 * 96}};  // 83
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        double values[LAUNCHES];
        fill_between(values, cases[i].median - cases[i].swing, cases[i].median + cases[i].swing);
        const struct rg_settling s = settle(values, 0, INFINITY, 12);
        assert_int_equal(s.settled, RG_SETTLED_OPEN);
        assert_int_equal(s.needed, cases[i].needed);
        assert_int_equal(settle(values, 0, INFINITY, 10).needed, cases[i].needed);
        assert_near(s.spread, 1.4826 * cases[i].swing, 1e-9);
    }
    double values[LAUNCHES];
    fill_between(values, 0.2, 0.21);
    assert_int_equal(settle(values, 0, INFINITY, 0).needed, 12);
    assert_int_equal(settle(values, 0, INFINITY, 12).needed, 24); // to confirm it
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(looks_and_confirmation),
        cmocka_unit_test(at_the_bound),
        cmocka_unit_test(several_parts),
        cmocka_unit_test(bounds_have_two_sides),
        cmocka_unit_test(a_single_launch_has_bounds),
        cmocka_unit_test(the_part_that_decides_is_named),
        cmocka_unit_test(parts_share_the_error_of_failing),
        cmocka_unit_test(the_rule_is_the_promised_one),
        cmocka_unit_test(launches_needed_follow_from_the_spread),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
