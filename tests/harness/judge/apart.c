// Verdicts against a baseline: closed cases, noise with a known truth, and the course that leads to
// them.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "harness/judge/course.h"
#include "tests/harness/judge/chance.h"
#include "tests/tools/expect.h"

// --- noise ---

enum noise { NORMAL, SKEWED, TWO_STATES, LINKED, NOISES };

// A launch's logarithm, with the measured spread between launches of one program, 4.5 %.
static double noise_of(enum noise noise, double *last)
{
    switch (noise) {
    case SKEWED: // never far below, now and then far above
        return -0.04 * log(uniform());
    case TWO_STATES: // caches lie well or badly
        return 0.01 * normal() + 0.07 * (uniform() < 0.4);
    case LINKED: // a machine that is warm for a while
        *last = 0.4 * *last + 0.041 * normal();
        return *last;
    default:
        return 0.045 * normal();
    }
}

static void fill(enum noise noise, double log_ms, double *logs, int count)
{
    double last = 0;
    for (int i = 0; i < 20; i++)
        noise_of(noise, &last);
    for (int i = 0; i < count; i++)
        logs[i] = log_ms + noise_of(noise, &last);
}

// --- the shift and its interval ---

// All ways to divide m + n ranks are equally probable: the share of those with fewer than k pairs
// of U.
static double share_below(int m, int n, int k)
{
    int below = 0, all = 0;
    for (unsigned set = 0; set < 1U << (m + n); set++) {
        int u = 0, as = 0;
        for (int i = 0; i < m + n; i++) {
            as += set >> i & 1;
            u += set >> i & 1 ? 0 : as;
        }
        if (as != m)
            continue;
        all++;
        below += u < k;
    }
    return (double)below / all;
}

// The ends of the interval are the differences at the ranks that counting gives, for each pair of
// sizes and each tail.
static void test_exact(void **state)
{
    (void)state;
    static const double tails[] = {0.0011, 0.0103, 0.0257, 0.1013, 0.2017}; // no share is equal
    for (int m = 1; m <= 6; m++)
        for (int n = 1; n <= 6; n++)
            for (int t = 0; t < 5; t++) {
                double a[6], b[6];
                for (int i = 0; i < m; i++)
                    a[i] = 100 * ((i * 7) % m);
                for (int j = 0; j < n; j++)
                    b[j] = 1 + (j * 7) % n; // so that all differences differ
                int k = 0;
                while (k < m * n / 2 && share_below(m, n, k + 1) <= tails[t])
                    k++;
                const struct rg_interval found = rg_shift(a, m, b, n, tails[t]);
                if (!k) {
                    assert_true(isnan(found.low) && isnan(found.high));
                    continue;
                }
                int below = 0, above = 0;
                for (int i = 0; i < m * n; i++) {
                    below += b[i % n] - a[i / n] < found.low;
                    above += b[i % n] - a[i / n] > found.high;
                }
                assert_int_equal(below, k - 1);
                assert_int_equal(above, k - 1);
            }
}

// The estimate is the median of the differences of all pairs. Adding to b adds to it, and swapping
// a and b changes its sign.
static void test_estimate(void **state)
{
    (void)state;
    const double a[] = {3, 1, 2}, b[] = {14, 10};
    // the differences: 7 8 9 11 12 13
    assert_near(rg_shift(a, 3, b, 2, 0.1).median, 10, 1e-12);
    assert_near(rg_shift(b, 2, a, 3, 0.1).median, -10, 1e-12);
    const struct rg_interval all = rg_shift(a, 3, b, 2, 0.1);
    assert_near(all.low, 7, 1e-12);
    assert_near(all.high, 13, 1e-12);
}

// An interval of 95 % holds the truth in 95 % of trials, even at the largest sample size.
static void test_coverage(void **state)
{
    (void)state;
    enum { TRIALS = 2000 };
    static const int sizes[][2] = {{8, 24}, {24, 16}, {64, 64}};
    state_of_chance = 3;
    for (enum noise noise = 0; noise < LINKED; noise++)
        for (int s = 0; s < 3; s++) {
            int held = 0;
            for (int trial = 0; trial < (s == 2 ? TRIALS / 8 : TRIALS); trial++) {
                double a[RG_SHIFT_SAMPLES], b[RG_SHIFT_SAMPLES];
                fill(noise, 1, a, sizes[s][0]);
                fill(noise, 1.1, b, sizes[s][1]);
                const struct rg_interval i = rg_shift(a, sizes[s][0], b, sizes[s][1], 0.025);
                held += i.low <= 0.1 && 0.1 <= i.high;
            }
            assert_at_least(held, (s == 2 ? 0.92 * TRIALS / 8 : 0.94 * TRIALS));
        }
}

// --- verdicts ---

static struct rg_gate_sample sample_of(double ms, double swing, int count)
{
    struct rg_gate_sample sample = {.count = count};
    for (int i = 0; i < count; i++)
        sample.logs[i] = log(ms) + swing * ((i * 7) % count - (count - 1) / 2.0) / count;
    return sample;
}

// No regression: a sure change within the spread between runs, or a large, unsure one. A
// regression: the interval is above half of the margin, and the ratio above all of it.
static void test_verdicts(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_apart(1);
    static const struct {
        double ratio, swing;
        enum rg_verdict_of_two verdict;
    } cases[] = {{1, 0.01, RG_TWO_PASS},           {1.08, 0.01, RG_TWO_PASS},
                 {0.93, 0.01, RG_TWO_PASS},        {1.099, 0.02, RG_TWO_INCONCLUSIVE},
                 {1.11, 0.01, RG_TWO_REGRESSED},   {1.15, 0.08, RG_TWO_REGRESSED},
                 {0.89, 0.01, RG_TWO_IMPROVED},    {1.12, 0.3, RG_TWO_INCONCLUSIVE},
                 {0.89, 0.3, RG_TWO_INCONCLUSIVE}, {1, 0.6, RG_TWO_INCONCLUSIVE}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const struct rg_gate_sample a = sample_of(10, cases[i].swing, 23);
        const struct rg_gate_sample b = sample_of(10 * cases[i].ratio, cases[i].swing, 16);
        const struct rg_gate_decision d = rg_gate_decide_apart(&rule, &a, b.logs, b.count);
        assert_int_equal(d.verdict, cases[i].verdict);
        assert_near(d.ratio, cases[i].ratio, 0.02);
        assert_int_equal(d.units, 16);
    }
    const struct rg_gate_sample none = {.count = 0}, some = sample_of(10, 0.01, 16);
    assert_int_equal(rg_gate_decide_apart(&rule, &none, some.logs, 16).units, 0);
    assert_int_equal(rg_gate_decide_apart(&rule, &some, some.logs, 0).verdict, RG_TWO_INCONCLUSIVE);
}

// Half of the absolute distances from the median are at most 6 of 23 steps of `a`, and 4 of 16 of
// `b`. The interval's end must be half of the margin above 0, and the median all of it; 95 % power
// needs 1.645 errors more. With three times the swing the first is the harder.
static void test_what_could_be_seen(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = {
        .is_apart = true, .margin = 0.1, .error = 0.05, .rows = 1, .look_count = 1, .looks = {16}};
    for (int times = 1; times <= 3; times += 2) {
        const struct rg_gate_sample a = sample_of(10, 0.1 * times, 23);
        const struct rg_gate_sample b = sample_of(10, 0.05 * times, 16);
        const double of_a = 1.4826 * 0.1 * times * 6 / 23, of_b = 1.4826 * 0.05 * times * 4 / 16;
        const double error = sqrt((of_a * of_a / 23 + of_b * of_b / 16) / 3 * acos(-1));
        const double least = times > 1 ? log1p(0.05) + 1.959964 * error : log1p(0.1);
        struct rg_gate_decision d = rg_gate_decide_apart(&rule, &a, b.logs, 16);
        assert_near(d.spread, of_a, 1e-9);
        assert_near(d.error, error, 1e-6);
        assert_near(d.smallest, expm1(least + 1.644854 * error), 1e-5);
        assert_near(rg_gate_power(&rule, &d, expm1(least)), 0.5, 1e-4);
        assert_near(d.shift, d.ratio, 1e-12);
        assert_false(d.is_grouped);
        d = rg_gate_decide_apart(&rule, &b, a.logs, 23);
        assert_near(d.spread, of_a, 1e-9);
        assert_int_equal(d.units, 23);
    }
}

// Advice has an infinite margin, and so no verdict worth printing.
static void test_advice(void **state)
{
    (void)state;
    struct rg_gate_rule rule = rg_gate_rule_apart(1);
    rule.margin = INFINITY;
    const struct rg_gate_sample a = sample_of(10, 0.01, 24), b = sample_of(30, 0.01, 24);
    const struct rg_gate_decision d = rg_gate_decide_apart(&rule, &a, b.logs, b.count);
    assert_int_equal(d.verdict, RG_TWO_PASS);
    assert_near(d.ratio, 3, 0.01);
}

// Rows and looks share the error, so more rows widen the intervals.
static void test_shared(void **state)
{
    (void)state;
    const struct rg_gate_sample a = sample_of(10, 0.1, 24), b = sample_of(10, 0.1, 16);
    struct rg_gate_rule rule = rg_gate_rule_apart(1);
    const struct rg_gate_decision one = rg_gate_decide_apart(&rule, &a, b.logs, b.count);
    rule.rows = 30;
    const struct rg_gate_decision many = rg_gate_decide_apart(&rule, &a, b.logs, b.count);
    assert_below(many.low, one.low);
    assert_above(many.high, one.high);
    assert_above(many.smallest, one.smallest);
    assert_near(rg_gate_power(&rule, &many, many.smallest), 0.95, 1e-6);
}

// Launches whose noise is correlated are counted in groups, in either sample.
static void test_links(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_apart(1);
    struct rg_gate_sample linked = {.count = 64}, plain = sample_of(10, 0.1, 31);
    for (int i = 0; i < 64; i++)
        linked.logs[i] = log(10) + (i % 16 < 8 ? 0.02 : -0.02);
    struct rg_gate_decision d = rg_gate_decide_apart(&rule, &plain, linked.logs, 64);
    assert_true(d.is_grouped);
    assert_below(d.units, 64);
    d = rg_gate_decide_apart(&rule, &linked, plain.logs, 31);
    assert_true(d.is_grouped);
    assert_int_equal(d.units, 31);
    d = rg_gate_decide_apart(&rule, &plain, plain.logs, 31);
    assert_false(d.is_grouped);
}

// --- courses on noise with a known truth ---

struct script {
    enum noise noise;
    double log_ms, last, later_log_ms;
    int launches, later; // 0: never
};

static bool launch(int number, void *user)
{
    struct script *s = user;
    (void)number;
    s->launches++;
    return true;
}

static bool take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    struct script *s = user;
    (void)row;
    (void)b_first;
    const double due = s->later && s->launches > s->later ? s->later_log_ms : s->log_ms;
    const double log_ms = due + noise_of(s->noise, &s->last);
    *quads = (struct rg_quads){.log = log_ms, .b_ms = exp(log_ms)};
    return true;
}

// A gate against a baseline of 24 launches. Runs differ by a spread of `between`, and the program
// now takes `ratio` times as long.
static struct rg_gate_row run_course(enum noise noise, double ratio, double between)
{
    struct script s = {.noise = noise, .log_ms = 1 + log(ratio) + between * normal()};
    const struct rg_gate_rule rule = rg_gate_rule_apart(1);
    struct rg_gate_sample before = {.count = 24};
    struct rg_gate_row found;
    fill(noise, 1, before.logs, before.count);
    const struct rg_quad_source source = {launch, take, NULL, &s, &before};
    assert_true(rg_course_run(&rule, &source, RG_COURSE_SEED, &found));
    return found;
}

static void count_verdicts(enum noise noise, double ratio, double between, int counts[4])
{
    enum { TRIALS = 400 };
    for (int i = 0; i < 4; i++)
        counts[i] = 0;
    for (int trial = 0; trial < TRIALS; trial++)
        counts[run_course(noise, ratio, between).decision.verdict]++;
}

// At most one of 400 gates on identical programs, whose runs differ by 2 %, finds a change, in each
// kind of noise.
static void test_same(void **state)
{
    (void)state;
    state_of_chance = 1;
    for (enum noise noise = 0; noise < NOISES; noise++) {
        int counts[4];
        count_verdicts(noise, 1, 0.02, counts);
        assert_between(counts[RG_TWO_REGRESSED] + counts[RG_TWO_IMPROVED], 0, 1);
        assert_between(counts[RG_TWO_PASS], noise == LINKED ? 360 : 380, 400);
    }
}

// All of 400 gates but two find a program that takes 15 % longer, or less.
static void test_slower(void **state)
{
    (void)state;
    state_of_chance = 2;
    for (enum noise noise = 0; noise < LINKED; noise++) {
        int counts[4];
        count_verdicts(noise, 1.15, 0, counts);
        assert_between(counts[RG_TWO_REGRESSED], 398, 400);
        count_verdicts(noise, 1 / 1.15, 0, counts);
        assert_between(counts[RG_TWO_IMPROVED], 398, 400);
    }
}

// A course reports A's time. Its finding must be confirmed by launches of its own.
static void test_course(void **state)
{
    (void)state;
    state_of_chance = 4;
    struct rg_gate_sample before = sample_of(20, 0.01, 24);
    struct script s = {.noise = TWO_STATES, .log_ms = log(30)};
    const struct rg_gate_rule rule = rg_gate_rule_apart(1);
    const struct rg_quad_source source = {launch, take, NULL, &s, &before};
    struct rg_gate_row found;
    assert_true(rg_course_run(&rule, &source, RG_COURSE_SEED, &found));
    assert_int_equal(found.decision.verdict, RG_TWO_REGRESSED);
    assert_int_equal(found.launches, 16);
    assert_near(found.a_ms.median, 20, 0.05);
    assert_near(found.b_ms.median, 31, 1);
    s = (struct script){
        .noise = TWO_STATES, .log_ms = log(30), .later = 8, .later_log_ms = log(20)};
    assert_true(rg_course_run(&rule, &source, RG_COURSE_SEED, &found));
    assert_int_equal(found.end, RG_END_UNCONFIRMED);
    assert_int_equal(found.decision.verdict, RG_TWO_INCONCLUSIVE);
}

static bool take_as_before(int row, bool b_first, struct rg_quads *quads, void *user)
{
    const struct rg_gate_sample *before = user;
    (void)b_first;
    *quads = (struct rg_quads){.log = before[row].logs[0], .b_ms = exp(before[row].logs[0])};
    return true;
}

static bool launch_any(int number, void *user)
{
    (void)user;
    return number >= 0;
}

// Each row is held against its own earlier times.
static void test_rows(void **state)
{
    (void)state;
    const struct rg_gate_rule rule = rg_gate_rule_apart(2);
    struct rg_gate_sample before[] = {sample_of(20, 0.01, 24), sample_of(30, 0.01, 24)};
    const struct rg_quad_source source = {launch_any, take_as_before, NULL, before, before};
    struct rg_gate_row found[2];
    assert_true(rg_course_run(&rule, &source, RG_COURSE_SEED, found));
    for (int row = 0; row < 2; row++) {
        assert_int_equal(found[row].decision.verdict, RG_TWO_PASS);
        assert_near(found[row].decision.ratio, 1, 0.01);
        assert_near(found[row].a_ms.median, row ? 30 : 20, 0.1);
        assert_near(found[row].b_ms.median, row ? 30 : 20, 0.3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact),    cmocka_unit_test(test_estimate),
        cmocka_unit_test(test_coverage), cmocka_unit_test(test_verdicts),
        cmocka_unit_test(test_advice),   cmocka_unit_test(test_shared),
        cmocka_unit_test(test_links),    cmocka_unit_test(test_same),
        cmocka_unit_test(test_slower),   cmocka_unit_test(test_course),
        cmocka_unit_test(test_rows),     cmocka_unit_test(test_what_could_be_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
