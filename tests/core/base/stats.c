// Medians and their intervals, compared with printed tables.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "core/base/stats.h"
#include "tests/tools/expect.h"

// The numbers from 1 to count, unsorted: ranks are their own values.
static void fill(double *samples, int count)
{
    for (int i = 0; i < count; i++)
        samples[i] = (double)((i * 7 + 3) % count) + 1;
}

// Ranks of the sign test's 95 % interval, from its printed tables (no count is a multiple of 7).
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
        assert_equals(interval.median, (rows[i].count + 1) / 2.0);
        assert_equals(interval.low, rows[i].low);
        assert_equals(interval.high, rows[i].count + 1 - rows[i].low);
    }
}

// With fewer than 6 samples there is no interval.
static void test_few(void **state)
{
    (void)state;
    double samples[5];
    for (int count = 1; count <= 5; count++) {
        fill(samples, count);
        const struct rg_interval interval = rg_median(samples, count);
        assert_equals(interval.median, (count + 1) / 2.0);
        assert_true(isnan(interval.low) && isnan(interval.high));
    }
}

// Of 2 and of 3 launches Student's distribution has a closed form: tan(pi (p - 1/2)), and
// (2 p - 1) / sqrt(2 p (1 - p)), where p is 0.975.
static void test_two_and_three_launches(void **state)
{
    (void)state;
    const double pi = acos(-1), of_two = tan(0.475 * pi), of_three = 0.95 / sqrt(0.04875);
    double two[] = {exp(2), 1}, three[] = {4, 1, 2};
    struct rg_interval interval = rg_median_of_launches(two, 2);
    assert_near(interval.median, (1 + exp(2)) / 2, 1e-12);
    assert_near(log(interval.low), 1 - of_two, 1e-4);
    assert_near(log(interval.high), 1 + of_two, 1e-4);
    interval = rg_median_of_launches(three, 3);
    assert_equals(interval.median, 2);
    assert_near(log2(interval.low), 1 - of_three / sqrt(3), 1e-4);
    assert_near(log2(interval.high), 1 + of_three / sqrt(3), 1e-4);
}

// A number from a normal distribution, by the sum of twelve even ones.
static double normal(unsigned int *seed)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) {
        *seed = *seed * 1664525 + 1013904223;
        sum += *seed / 4294967296.0;
    }
    return sum;
}

// Of 4,000 sets of launches, 95 % have intervals that hold the true time.
static void test_launches_cover_the_truth(void **state)
{
    (void)state;
    unsigned int seed = 7;
    for (int count = 2; count <= 5; count++) {
        int held = 0;
        for (int set = 0; set < 4000; set++) {
            double times[5];
            for (int i = 0; i < count; i++)
                times[i] = 30 * exp(0.1 * normal(&seed));
            const struct rg_interval interval = rg_median_of_launches(times, count);
            held += interval.low <= 30 && 30 <= interval.high;
        }
        assert_near(held, 3800, 50);
    }
}

// One launch has no interval; six or more have that of the sign test.
static void test_other_numbers_of_launches(void **state)
{
    (void)state;
    double one[] = {3}, six[] = {3, 1, 2, 6, 5, 4};
    struct rg_interval interval = rg_median_of_launches(one, 1);
    assert_equals(interval.median, 3);
    assert_true(isnan(interval.low) && isnan(interval.high));
    interval = rg_median_of_launches(six, 6);
    assert_equals(interval.median, 3.5);
    assert_equals(interval.low, 1);
    assert_equals(interval.high, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranks),
        cmocka_unit_test(test_few),
        cmocka_unit_test(test_two_and_three_launches),
        cmocka_unit_test(test_launches_cover_the_truth),
        cmocka_unit_test(test_other_numbers_of_launches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
