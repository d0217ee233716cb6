// Verdicts on two sides whose difference is known: closed cases, and noise with a known truth.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/judge/decide.h"
#include "tests/harness/judge/chance.h"
#include "tests/tools/expect.h"

// --- noise ---

enum noise { NORMAL, SKEWED, TWO_STATES, LINKED, NOISES };

// A launch's logarithm around a median of 0, with the spread of a launch, 3 %.
static double noise_of(enum noise noise, double *last)
{
    switch (noise) {
    case SKEWED: // the difference of two values that are far above now and then
        return 0.02 * (log(uniform()) - log(uniform()));
    case TWO_STATES: // caches lie well or badly, for each side by itself
        return 0.004 * normal() + 0.03 * ((uniform() < 0.4) - (uniform() < 0.4));
    case LINKED: // a machine that is warm for a while
        *last = 0.4 * *last + 0.0275 * normal();
        return *last;
    default:
        return 0.03 * normal();
    }
}

static void fill(enum noise noise, double change, double *logs, int count)
{
    double last = 0;
    for (int i = 0; i < 20; i++)
        noise_of(noise, &last);
    for (int i = 0; i < count; i++)
        logs[i] = log1p(change) + noise_of(noise, &last);
}

// --- closed cases ---

// docs/ci.md promises these margins, errors and looks.
static void test_rules(void **state)
{
    (void)state;
    const struct rg_gate_rule turns = rg_gate_rule_of(3), apart = rg_gate_rule_apart(7);
    assert_false(turns.is_apart);
    assert_equals(turns.margin, 0.05);
    assert_equals(turns.error, 0.01);
    assert_int_equal(turns.rows, 3);
    assert_int_equal(turns.look_count, 5);
    assert_memory_equal(turns.looks, ((int[]){16, 32, 64, 128, 256}), 5 * sizeof(int));
    assert_true(apart.is_apart);
    assert_equals(apart.margin, 0.1);
    assert_equals(apart.error, 0.01);
    assert_int_equal(apart.rows, 7);
    assert_int_equal(apart.look_count, 3);
    assert_memory_equal(apart.looks, ((int[]){8, 16, 32}), 3 * sizeof(int));
    static const char *const names[] = {[RG_TWO_INCONCLUSIVE] = "inconclusive",
                                        [RG_TWO_PASS] = "pass",
                                        [RG_TWO_REGRESSED] = "regressed",
                                        [RG_TWO_IMPROVED] = "improved"};
    for (int i = 0; i < 4; i++)
        assert_string_equal(rg_two_name((enum rg_verdict_of_two)i), names[i]);
}

// A machine that slows down steadily slows both sides alike. A side that takes twice as long has
// log 2.
static void test_quads(void **state)
{
    (void)state;
    const double a[] = {10, 10 * 1.1 * 1.1 * 1.1}, b[] = {10 * 1.1, 10 * 1.1 * 1.1};
    assert_near(rg_block_log_ratio(a, b), 0, 1e-12);
    const double twice[] = {20 * 1.1, 20 * 1.1 * 1.1};
    assert_near(rg_block_log_ratio(a, twice), log(2), 1e-12);
    assert_near(rg_block_log_ratio(twice, a), -log(2), 1e-12);
}

// With 16 launches and a tail of 0.0005, all must be on one side but one. The interval's ends are
// the smallest and the largest, or their neighbours, by the binomial distribution.
static void test_interval(void **state)
{
    (void)state;
    struct rg_gate_rule rule = {
        .margin = 0.05, .error = 0.001, .rows = 1, .look_count = 1, .looks = {16}};
    double logs[16];
    for (int i = 0; i < 16; i++)
        logs[i] = 0.001 * ((i * 7) % 16 - 7.5);
    struct rg_gate_decision d = rg_gate_decide(&rule, logs, 16);
    // P(X = 0) + P(X = 1) is 17 / 65536; with P(X = 2) it is 137 / 65536.
    assert_near(d.low, exp(-0.0065), 1e-12);
    assert_near(d.high, exp(0.0065), 1e-12);
    assert_near(d.ratio, 1, 1e-12);
    assert_near(d.shift, 1, 1e-12);
    assert_int_equal(d.verdict, RG_TWO_PASS);
    rule.rows = 2; // each gets half of the error: 17 / 65536 is more than 0.00025
    d = rg_gate_decide(&rule, logs, 16);
    assert_near(d.low, exp(-0.0075), 1e-12);
    rule.look_count = 20; // a tail of 0.0000125, for which 16 launches are too few
    d = rg_gate_decide(&rule, logs, 16);
    assert_equals(d.low, 0);
    assert_true(isinf(d.high));
    assert_int_equal(d.verdict, RG_TWO_INCONCLUSIVE);
    d = rg_gate_decide(&rule, logs, 0);
    assert_int_equal(d.verdict, RG_TWO_INCONCLUSIVE);
    assert_int_equal(d.units, 0);
}

// A sure, small change is no regression, nor is a large, unsure one.
static void test_verdicts(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    static const struct {
        double change, swing;
        enum rg_verdict_of_two verdict;
    } cases[] = {{0, 0.001, RG_TWO_PASS},          {0.02, 0.001, RG_TWO_PASS},
                 {-0.02, 0.001, RG_TWO_PASS},      {0.03, 0.001, RG_TWO_REGRESSED},
                 {0.2, 0.01, RG_TWO_REGRESSED},    {-0.03, 0.001, RG_TWO_IMPROVED},
                 {0.03, 0.1, RG_TWO_INCONCLUSIVE}, {-0.03, 0.1, RG_TWO_INCONCLUSIVE},
                 {0, 0.2, RG_TWO_INCONCLUSIVE}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        double logs[32];
        for (int k = 0; k < 32; k++)
            logs[k] = log1p(cases[i].change) + cases[i].swing * ((k * 13) % 32 - 15.5) / 15.5;
        assert_int_equal(rg_gate_decide(&rule, logs, 32).verdict, cases[i].verdict);
    }
}

// Launches whose noise is correlated are counted in groups, which grow until neighbours are not
// alike: here fours.
static void test_links(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    double logs[66];
    for (int i = 0; i < 66; i++)
        logs[i] = i % 16 < 8 ? 0.02 + 0.0001 * i : -0.02 + 0.0001 * i;
    struct rg_gate_decision d = rg_gate_decide(&rule, logs, 66);
    assert_true(d.is_grouped);
    assert_int_equal(d.units, 16);
    for (int i = 0; i < 66; i++)
        logs[i] = i % 2 ? 0.02 : -0.02;
    d = rg_gate_decide(&rule, logs, 66);
    assert_false(d.is_grouped);
    assert_int_equal(d.units, 66);
}

// As many launches above their median as below it, which change sides so often, an odd number.
static void fill_changing(double *logs, int count, int changes)
{
    int at = 0;
    for (int run = 0; run <= changes; run++) {
        const int length = run < changes - 1 ? 1 : (count - changes + 1) / 2;
        for (int i = 0; i < length; i++)
            logs[at++] = run % 2 ? -0.02 : 0.02;
    }
    assert_int_equal(at, count);
}

// The autocorrelation of such launches is (count - 1 - 2 changes) / count. It must exceed both 0.2
// and 1.645 / sqrt(count), which is 0.58 for 8 launches, 0.41 for 16 and 0.10 for 256.
static void test_what_links(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    static const struct {
        int count, changes;
        bool is_grouped;
    } cases[] = {{8, 1, true},       // 0.63
                 {16, 3, true},      // 0.56
                 {16, 5, false},     // 0.31
                 {256, 99, true},    // 0.22
                 {256, 107, false}}; // 0.16
    double logs[256];
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        fill_changing(logs, cases[i].count, cases[i].changes);
        const struct rg_gate_decision d = rg_gate_decide(&rule, logs, cases[i].count);
        assert_int_equal(d.is_grouped, cases[i].is_grouped);
        if (!d.is_grouped)
            assert_int_equal(d.units, cases[i].count);
    }
}

// A group counts as the mean of its two launches.
static void test_groups_are_means(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    const double logs[] = {0.05, 0.055, 0.05, 0.055, -0.05, -0.055, -0.05, -0.055};
    const struct rg_gate_decision d = rg_gate_decide(&rule, logs, 8);
    assert_int_equal(d.units, 4);
    assert_near(d.ratio, 1, 1e-12);
    assert_near(d.spread, 1.4826 * 0.0525, 1e-12);
}

// A timer that shows no difference in more than one of twenty launches decides nothing.
static void test_coarse(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    static const struct {
        int count, ties;
        bool is_coarse;
    } cases[] = {{20, 1, false}, {20, 2, true}, {64, 3, false}, {64, 4, true}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        double logs[64];
        for (int k = 0; k < cases[i].count; k++)
            logs[k] = k < cases[i].ties ? 0 : 0.0001 * ((k * 29) % 64 - 31.5);
        const struct rg_gate_decision d = rg_gate_decide(&rule, logs, cases[i].count);
        assert_int_equal(d.is_coarse, cases[i].is_coarse);
        assert_int_equal(d.verdict, cases[i].is_coarse ? RG_TWO_INCONCLUSIVE : RG_TWO_PASS);
    }
}

// The means of all pairs, in hundredths: 1, 1.5, 2, 3.5, 4 and 6.
static void test_shift(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    const double logs[] = {0.06, 0.01, 0.02};
    const struct rg_gate_decision d = rg_gate_decide(&rule, logs, 3);
    assert_near(d.shift, exp(0.0275), 1e-12);
    assert_near(d.ratio, exp(0.02), 1e-12);
}

// Launches beyond RG_GATE_UNITS are left out.
static void test_most_launches(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    static double logs[RG_GATE_UNITS + 100];
    for (int i = 0; i < RG_GATE_UNITS + 100; i++)
        logs[i] = i >= RG_GATE_UNITS ? 9 : i % 2 ? 0.02 : 0.01;
    const struct rg_gate_decision d = rg_gate_decide(&rule, logs, RG_GATE_UNITS + 100);
    assert_int_equal(d.units, RG_GATE_UNITS);
    assert_near(d.ratio, exp(0.015), 1e-12);
}

// Of more launches than the shift takes, it takes some from all.
static void test_shift_of_many(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    double logs[256];
    for (int i = 0; i < 256; i++)
        logs[i] = 0.0001 * ((i * 29) % 256 + 1);
    assert_near(rg_gate_decide(&rule, logs, 256).shift, exp(0.0127), 0.0003);
}

// With a spread s, the error of a median of 64 launches is 1.2533 s / 8. With a tail of 0.025 the
// interval must be 1.96 errors above 0, and 95 % power needs 1.645 errors more.
static void test_what_could_be_seen(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = {
        .margin = 0.01, .error = 0.05, .rows = 1, .look_count = 1, .looks = {64}};
    double logs[64];
    for (int i = 0; i < 64; i++)
        logs[i] = 0.002 * ((i * 29) % 64 - 31.5);
    struct rg_gate_decision d = rg_gate_decide(&rule, logs, 64);
    assert_near(d.spread, 1.4826 * 0.032, 1e-9);
    const double error = 1.2533 * d.spread / 8;
    assert_near(d.smallest, expm1((1.959964 + 1.644854) * error), 1e-6);
    assert_near(rg_gate_power(&rule, &d, d.smallest), 0.95, 1e-6);
    assert_near(rg_gate_power(&rule, &d, expm1(1.959964 * error)), 0.5, 1e-6);
    // With little spread, half of the margin decides.
    for (int i = 0; i < 64; i++)
        logs[i] *= 0.001;
    d = rg_gate_decide(&rule, logs, 64);
    assert_near(d.smallest, expm1(log1p(0.005) + 1.644854 * error * 0.001), 1e-8);
    // Without any, a change is noticed if it is more than half of the margin.
    for (int i = 0; i < 64; i++)
        logs[i] = 0.001;
    d = rg_gate_decide(&rule, logs, 64);
    assert_equals(rg_gate_power(&rule, &d, 0.0051), 1);
    assert_equals(rg_gate_power(&rule, &d, 0.0049), 0);
    // Launches too few for an interval could show nothing, however alike they are.
    d = rg_gate_decide(&rule, logs, 4);
    assert_true(isinf(d.smallest));
    assert_equals(rg_gate_power(&rule, &d, 0.05), 0);
    assert_int_equal(d.verdict, RG_TWO_INCONCLUSIVE);
}

// --- noise with a known truth ---

static void count_verdicts(enum noise noise, double change, int launches, int counts[4])
{
    enum { TRIALS = 400 };
    const struct rg_gate_rule rule = rg_gate_rule_of(1);
    for (int i = 0; i < 4; i++)
        counts[i] = 0;
    for (int trial = 0; trial < TRIALS; trial++) {
        double logs[RG_GATE_UNITS];
        fill(noise, change, logs, launches);
        counts[rg_gate_decide(&rule, logs, launches).verdict]++;
    }
}

// With few launches and with many, at most one of 400 equal pairs is found to differ. Correlated
// launches are not always noticed; the test of courses covers these (course.c).
static void test_same(void **state)
{
    (void)state;
    state_of_chance = 1;
    for (enum noise noise = 0; noise < LINKED; noise++)
        for (int launches = 16; launches <= 256; launches *= 4) {
            int counts[4];
            count_verdicts(noise, 0, launches, counts);
            assert_between(counts[RG_TWO_REGRESSED] + counts[RG_TWO_IMPROVED], 0, 1);
            if (launches == 256)
                assert_between(counts[RG_TWO_PASS], 396, 400);
        }
}

// 256 launches find a side that takes 5 % longer, or less, in all of 400 trials but two.
static void test_slower(void **state)
{
    (void)state;
    state_of_chance = 2;
    for (enum noise noise = 0; noise < LINKED; noise++) { // in groups, 256 launches are too few
        int counts[4];
        count_verdicts(noise, 0.05, 256, counts);
        assert_between(counts[RG_TWO_REGRESSED], 398, 400);
        count_verdicts(noise, 1 / 1.05 - 1, 256, counts);
        assert_between(counts[RG_TWO_IMPROVED], 398, 400);
    }
}

// An interval of 95 % holds the truth in 95 % of trials.
static void test_coverage(void **state)
{
    (void)state;
    enum { TRIALS = 2000 };
    const struct rg_gate_rule rule = {
        .margin = 0.05, .error = 0.05, .rows = 1, .look_count = 1, .looks = {40}};
    state_of_chance = 3;
    for (enum noise noise = 0; noise < NOISES; noise++) {
        int held = 0;
        for (int trial = 0; trial < TRIALS; trial++) {
            double logs[160];
            fill(noise, 0.01, logs, 160);
            const struct rg_gate_decision d = rg_gate_decide(&rule, logs, 160);
            held += d.low <= 1.01 && 1.01 <= d.high;
        }
        assert_at_least(held, 0.94 * TRIALS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rules),
        cmocka_unit_test(test_what_links),
        cmocka_unit_test(test_groups_are_means),
        cmocka_unit_test(test_shift),
        cmocka_unit_test(test_most_launches),
        cmocka_unit_test(test_quads),
        cmocka_unit_test(test_interval),
        cmocka_unit_test(test_verdicts),
        cmocka_unit_test(test_links),
        cmocka_unit_test(test_coarse),
        cmocka_unit_test(test_what_could_be_seen),
        cmocka_unit_test(test_shift_of_many),
        cmocka_unit_test(test_same),
        cmocka_unit_test(test_slower),
        cmocka_unit_test(test_coverage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
