// Medians, their intervals and slopes, against what tables print.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "harness/record/stats.h"

// The numbers from 1 to count in an order that is none: ranks are their own values.
static void fill(double *samples, int count)
{
    for (int i = 0; i < count; i++)
        samples[i] = (double)((i * 7 + 3) % count) + 1;
}

// Ranks of the sign test's interval of 95 %, as its tables print them (no count is a multiple of
// 7).
static void test_ranks(void **state)
{
    (void)state;
    static const struct {
        int count, low;
    } rows[] = {{6, 1},  {8, 1},  {9, 2},  {10, 2},  {11, 2},  {12, 3},  {15, 4},  {16, 4},
                {17, 5}, {20, 6}, {25, 8}, {30, 10}, {40, 14}, {50, 18}, {100, 40}};
    double samples[256];
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        fill(samples, rows[i].count);
        const struct rg_interval interval = rg_median(samples, rows[i].count);
        assert_true(interval.median == (rows[i].count + 1) / 2.0);
        assert_true(interval.low == rows[i].low);
        assert_true(interval.high == rows[i].count + 1 - rows[i].low);
    }
}

// With fewer than 6 samples it is their range.
static void test_few(void **state)
{
    (void)state;
    double samples[5];
    for (int count = 1; count <= 5; count++) {
        fill(samples, count);
        const struct rg_interval interval = rg_median(samples, count);
        assert_true(interval.median == (count + 1) / 2.0);
        assert_true(interval.low == 1 && interval.high == count);
    }
}

// A line with errors: 10 is the spread of x, 4.14 the mean of y, 3.182 Student's t of 3 degrees of
// freedom.
static void test_slope(void **state)
{
    (void)state;
    const double x[] = {1, 2, 3, 4, 5}, y[] = {2.1, 2.9, 4.3, 4.9, 6.5};
    double sum = 0;
    for (int i = 0; i < 5; i++)
        sum += pow(y[i] - 4.14 - 1.08 * (x[i] - 3), 2);
    const struct rg_interval found = rg_slope_interval(x, y, 5);
    const double half = 3.182 * sqrt(sum / 3 / 10);
    assert_true(fabs(rg_slope(x, y, 5) - (1.08)) < 1e-12);
    assert_true(fabs(found.median - (1.08)) < 1e-12);
    assert_true(fabs(found.low - (1.08 - half)) < 1e-12);
    assert_true(fabs(found.high - (1.08 + half)) < 1e-12);
    assert_true(isnan(rg_slope_interval(x, y, 2).low));
    assert_true(fabs(rg_slope_interval(x, y, 2).median - (0.8)) < 1e-12);
    const double same[] = {3, 3, 3};
    assert_true(isnan(rg_slope_interval(same, y, 3).median));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranks),
        cmocka_unit_test(test_few),
        cmocka_unit_test(test_slope),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
