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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranks),
        cmocka_unit_test(test_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
