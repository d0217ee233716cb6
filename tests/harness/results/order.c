// The probabilities in verdicts: orders of two sets match an enumeration or a count of all ways.
// Print's margin is its rounding and its scatter.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/claims/margin.h"
#include "harness/tables/claims/order.h"
#include "tests/tools/expect.h"

// --- the order of two sets ---

// The probability that at least `pairs` pairs have the first set's value below the second's, over
// all ways to give m of m + n ranks to the first set.
static double enumerated(int m, int n, int pairs)
{
    int ways = 0, as_far = 0;
    for (unsigned set = 0; set < 1u << (m + n); set++) {
        int size = 0, below = 0;
        for (int i = 0; i < m + n; i++) {
            size += set >> i & 1;
            below += set >> i & 1 ? 0 : size; // this rank of the other set has these below it
        }
        ways += size == m;
        as_far += size == m && below >= pairs;
    }
    return (double)as_far / ways;
}

static void check_drawn(int m, int n)
{
    double low[6], high[6];
    srand48(10 * m + n);
    int pairs = 0;
    for (int i = 0; i < m; i++)
        low[i] = drand48();
    for (int j = 0; j < n; j++)
        high[j] = drand48() + 0.2;
    for (int i = 0; i < m * n; i++)
        pairs += low[i % m] < high[i / m];
    const double found = rg_order_probability(low, m, 1, high, n);
    assert_below(fabs(found - enumerated(m, n, pairs)), 1e-12);
}

static void test_order_by_enumeration(void **state)
{
    (void)state;
    for (int m = 1; m <= 6; m++)
        for (int n = 1; n <= 6; n++)
            check_drawn(m, n);
    // The kept counts of the last question are of another m or another n, in turn.
    for (int n = 1; n <= 6; n++)
        for (int m = 1; m <= 6; m++)
            check_drawn(m, n);
}

// An equal pair counts half, and half of a pair is rounded down.
static void test_ties(void **state)
{
    (void)state;
    const double low[3] = {1, 2, 3}, high[3] = {3, 4, 5}, same[2] = {1, 1};
    assert_below(fabs(rg_order_probability(low, 3, 1, high, 3) - enumerated(3, 3, 8)), 1e-12);
    assert_below(fabs(rg_order_probability(same, 2, 1, same, 2) - enumerated(2, 2, 2)), 1e-12);
}

// Beyond 20 samples the normal distribution is used: equal samples are as far apart as often as it
// says.
static void test_many_samples(void **state)
{
    (void)state;
    srand48(3);
    int rare = 0, often = 0;
    for (int trial = 0; trial < 4000; trial++) {
        double low[25], high[25];
        for (int i = 0; i < 25; i++) {
            low[i] = drand48();
            high[i] = drand48();
        }
        const double p = rg_order_probability(low, 25, 1, high, 25);
        rare += p <= 0.025;
        often += p <= 0.5;
    }
    assert_between(rare, 70, 130);
    assert_between(often, 1900, 2100);
}

// The number of ways to choose m of m + n ranks with a given number of pairs in order. The highest
// rank belongs to one set or the other, which leaves m - 1 and n, or m and n - 1.
enum { MANY = 21, MOST_PAIRS = MANY * MANY };

static double ways[MANY + 1][MANY + 1][MOST_PAIRS + 1];

static void count_ways(void)
{
    for (int m = 0; m <= MANY; m++)
        for (int n = 0; n <= MANY; n++)
            for (int u = 0; u <= m * n; u++)
                ways[m][n][u] = !m || !n ? 1
                                         : (u <= (m - 1) * n ? ways[m - 1][n][u] : 0) +
                                               (u >= m ? ways[m][n - 1][u - m] : 0);
}

// Within 0.003 of the exact probability; half a pair is 0.005 in the middle.
static void test_many_are_nearly_exact(void **state)
{
    (void)state;
    count_ways();
    for (int shift = -3; shift <= 3; shift++) {
        double low[MANY], high[MANY], all = 0, as_far = 0;
        int pairs = 0;
        for (int i = 0; i < MANY; i++) {
            low[i] = i;
            high[i] = i + shift + 0.5;
        }
        for (int i = 0; i < MOST_PAIRS; i++)
            pairs += low[i % MANY] < high[i / MANY];
        for (int u = 0; u <= MOST_PAIRS; u++) {
            all += ways[MANY][MANY][u];
            as_far += u >= pairs ? ways[MANY][MANY][u] : 0;
        }
        const double found = rg_order_probability(low, MANY, 1, high, MANY);
        if (!(fabs(found - as_far / all) < 0.003))
            fail_msg("%d pairs: %g, not %g", pairs, found, as_far / all);
    }
}

static void test_a_factor(void **state)
{
    (void)state;
    const double low[5] = {1, 1.1, 1.2, 1.3, 1.4}, high[5] = {2.5, 2.6, 2.7, 2.8, 2.9};
    assert_below(rg_order_probability(low, 5, 1.7, high, 5), 0.01);
    assert_above(rg_order_probability(low, 5, 3, high, 5), 0.99);
}

// --- the margin of print ---

static void test_rounding(void **state)
{
    (void)state;
    assert_below(fabs(rg_margin_rounding(25) - 0.5 / 25), 1e-12);
    assert_below(fabs(rg_margin_rounding(22.5) - 0.05 / 22.5), 1e-12);
    assert_below(fabs(rg_margin_rounding(1.66) - 0.005 / 1.66), 1e-12);
    assert_equals(rg_margin_rounding(NAN), 0);
    assert_equals(rg_margin_rounding(INFINITY), 0);
    assert_equals(rg_margin_rounding(0), 0);
    assert_equals(rg_margin_rounding(-4), 0);
    assert_below(fabs(rg_margin_rounding(0.5) - 0.1), 1e-12);
    assert_true(rg_margin_orders(26.5, 25) && !rg_margin_orders(25.5, 25));
    // Each number has its own margin: 26 is at least 25.5.
    assert_true(rg_margin_orders(26, 25.4) && !rg_margin_orders(26, 25.6));
    assert_true(!rg_margin_orders(25, 26) && !rg_margin_orders(NAN, 1) &&
                !rg_margin_orders(1, NAN));
}

// The margin of printed numbers on a line, with the third row off by `off`. Its neighbours see
// half of that.
static double margin_of_line(int rows, double off)
{
    struct rg_slope_point points[5];
    double weights[5], printed[5];
    for (int i = 0; i < rows; i++) {
        points[i] = (struct rg_slope_point){.x = i};
        printed[i] = 123.4567 * exp(-i + (i == 2 ? off : 0)); // seven digits: hardly any rounding
    }
    rg_slope_weights(points, rows, weights);
    return rg_margin_slope(points, weights, printed, rows);
}

// Rows 2 to 4 are off by 0.1, 0.2 and 0.1 of a line, each seen with 1 + 1/4 + 1/4. So the median is
// 0.1 / 1.5^0.5, and the squares of the weights add up to 1/10.
static void test_scatter_of_print(void **state)
{
    (void)state;
    const double sigma = 0.1 / sqrt(1.5) / 0.6745;
    assert_below(fabs(margin_of_line(5, 0.2) - 1.96 * sigma / sqrt(10)), 1e-4);
    assert_below(margin_of_line(5, 0), 1e-4);
    // Of four rows two are off, by 0.1 and 0.2; the weights' squares add up to 1/5.
    assert_below(fabs(margin_of_line(4, 0.2) - 1.96 * 1.5 * sigma / sqrt(5)), 1e-4);
    // Neighbours of another group count for none: each group has two rows.
    const struct rg_slope_point four[] = {
        {.x = 0}, {.x = 1}, {2, 1, NULL, 0, 0}, {3, 1, NULL, 0, 0}};
    const double far[] = {100.0001, 90.00001, 500.0001, 80.00001},
                 of_four[] = {-0.5, 0.5, -0.5, 0.5};
    assert_below(rg_margin_slope(four, of_four, far, 4), 1e-6);
    // Rounding alone, of two rows: up to half a unit of 10 and of 20 either way, uniformly.
    const struct rg_slope_point two[] = {{.x = 0}, {.x = 1}};
    const double printed[] = {20, 10}, weights[] = {-1, 1};
    assert_below(fabs(rg_margin_slope(two, weights, printed, 2) -
                      1.96 * sqrt((0.025 * 0.025 + 0.05 * 0.05) / 3)),
                 1e-9);
}
int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_order_by_enumeration),
        cmocka_unit_test(test_ties),
        cmocka_unit_test(test_many_samples),
        cmocka_unit_test(test_many_are_nearly_exact),
        cmocka_unit_test(test_a_factor),
        cmocka_unit_test(test_rounding),
        cmocka_unit_test(test_scatter_of_print),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
