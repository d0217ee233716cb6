// Slopes of medians and their intervals, compared with known truths.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "harness/record/slope.h"
#include "kernels/dialect/rng.h"
#include "tests/tools/expect.h"

// Sums of squares, by hand: (1, 2, 4) has mean 7/3 and squares 42/9.
static void test_weights(void **state)
{
    (void)state;
    const struct rg_slope_point line[] = {{.x = 1}, {.x = 2}, {.x = 4}};
    const struct rg_slope_point groups[] = {
        {.x = 1}, {.x = 3}, {.x = 11, .group = 1}, {.x = 17, .group = 1}, {.x = 99, .group = 2}};
    const struct rg_slope_point same[] = {{.x = 3}, {.x = 3}};
    double w[5];
    rg_slope_weights(line, 3, w);
    for (int i = 0; i < 3; i++)
        assert_near(w[i], (line[i].x - 7.0 / 3) / (42.0 / 9), 1e-12);
    rg_slope_weights(groups, 5, w); // means 2, 14 and 99; squares 2 and 18
    assert_near(w[0], -1.0 / 20, 1e-12);
    assert_near(w[1], 1.0 / 20, 1e-12);
    assert_near(w[2], -3.0 / 20, 1e-12);
    assert_near(w[3], 3.0 / 20, 1e-12);
    assert_near(w[4], 0, 1e-12);
    rg_slope_weights(same, 2, w);
    assert_true(isnan(w[0]) && isnan(w[1]));
    assert_true(isnan(rg_slope_resampled(same, 0).median));
}

enum { ROWS = 4, MOST = 15, TRIALS = 400 };

// Rows whose true medians follow x to the power 0.7, with scatter that is skewed like times.
static void scatter(double samples[ROWS][MOST], int count, double width, int trial)
{
    for (int r = 0; r < ROWS; r++)
        for (int i = 0; i < count; i++) {
            const rg_uint4 bits = rg_random(5, (uint)trial, (uint)r, (uint)i);
            const double off = -log((bits.x + 0.5) * 0x1p-32) - log(2); // its median is 0
            samples[r][i] = pow(r + 1, 0.7) * exp(width * off);
        }
}

static struct rg_interval slope_of(double samples[ROWS][MOST], int count)
{
    struct rg_slope_point points[ROWS];
    for (int r = 0; r < ROWS; r++)
        points[r] = (struct rg_slope_point){.x = log(r + 1), .samples = samples[r], .count = count};
    return rg_slope_resampled(points, ROWS);
}

// The interval holds the truth in at least 95 % of trials. Its width is above 3.5 standard
// deviations of the slopes, since a normal distribution's has four, and below six.
static void test_coverage(void **state)
{
    (void)state;
    static const int counts[] = {6, MOST};
    for (int c = 0; c < 2; c++) {
        double samples[ROWS][MOST], sum = 0, squares = 0, width = 0;
        int held = 0;
        for (int trial = 0; trial < TRIALS; trial++) {
            scatter(samples, counts[c], 0.1, trial);
            const struct rg_interval s = slope_of(samples, counts[c]);
            held += s.low <= 0.7 && 0.7 <= s.high;
            sum += s.median / TRIALS;
            squares += s.median * s.median / TRIALS;
            width += (s.high - s.low) / TRIALS;
        }
        const double sigma = sqrt(squares - sum * sum);
        assert_near(sum, 0.7, 0.02);
        assert_at_least(held, 0.95 * TRIALS);
        assert_below(width, 6 * sigma);
        assert_above(width, 3.5 * sigma);
    }
}

// A machine that got slower along the axis, to the power 0.1, may have made the slope steeper by
// that. One that got faster may have hidden as much. A row without a load says nothing about the
// others.
static void test_drift(void **state)
{
    (void)state;
    double samples[ROWS][MOST];
    struct rg_slope_point points[ROWS];
    scatter(samples, MOST, 0.1, 1);
    for (int r = 0; r < ROWS; r++)
        points[r] = (struct rg_slope_point){.x = log(r + 1), .samples = samples[r], .count = MOST};
    const struct rg_interval still = rg_slope_resampled(points, ROWS);
    for (int sign = -1; sign <= 1; sign += 2) {
        for (int r = 0; r < ROWS; r++)
            points[r].load_ms = 2 * pow(r + 1, sign * 0.1);
        const struct rg_interval s = rg_slope_resampled(points, ROWS);
        assert_near(s.median, still.median, 1e-12);
        assert_near(s.low, still.low - 0.1, 1e-12);
        assert_near(s.high, still.high + 0.1, 1e-12);
    }
    points[2].load_ms = 0;
    assert_near(rg_slope_resampled(points, ROWS).low, still.low, 1e-12);
}

// A row of five samples gives no interval; with constant samples the interval is the slope itself.
static void test_no_interval(void **state)
{
    (void)state;
    double samples[ROWS][MOST];
    scatter(samples, 5, 0.1, 1);
    struct rg_interval s = slope_of(samples, 5);
    assert_true(isfinite(s.median) && isnan(s.low) && isnan(s.high));
    scatter(samples, 6, 0, 1);
    s = slope_of(samples, 6);
    assert_near(s.median, 0.7, 1e-12);
    assert_near(s.low, 0.7, 1e-12);
    assert_near(s.high, 0.7, 1e-12);
}

// Along the other direction all is reversed, ends of the interval too. What is slower throughout
// has the same slope, and so has what was sampled in another order.
static void test_symmetry(void **state)
{
    (void)state;
    double samples[ROWS][MOST], slower[ROWS][MOST];
    struct rg_slope_point points[ROWS], reversed[ROWS], others[ROWS];
    scatter(samples, MOST, 0.1, 2);
    for (int r = 0; r < ROWS; r++) {
        for (int i = 0; i < MOST; i++)
            slower[r][(i * 4 + r) % MOST] = 8 * samples[r][i];
        points[r] = (struct rg_slope_point){.x = log(r + 1), .samples = samples[r], .count = MOST};
        reversed[r] = others[r] = points[r];
        reversed[r].x = -points[r].x;
        others[r].samples = slower[r];
    }
    const struct rg_interval s = rg_slope_resampled(points, ROWS);
    const struct rg_interval back = rg_slope_resampled(reversed, ROWS);
    assert_near(back.median, -s.median, 1e-12);
    assert_near(back.low, -s.high, 1e-12);
    assert_near(back.high, -s.low, 1e-12);
    const struct rg_interval same = rg_slope_resampled(others, ROWS);
    assert_near(same.median, s.median, 1e-12);
    assert_near(same.low, s.low, 1e-12);
    assert_near(same.high, s.high, 1e-12);
    assert_above(s.high - s.low, 1e-3);
}

// Two points: the slope is that of the medians, of even numbers of samples too, and each group has
// a line of its own.
static void test_slope_of_medians(void **state)
{
    (void)state;
    const double low[] = {1, 1, 1, 3, 3, 3}, high[] = {16, 4, 16, 4, 4, 16};
    const double flat[] = {5, 5, 5, 5, 5, 5, 5};
    struct rg_slope_point points[] = {{.x = 0, .samples = low, .count = 6},
                                      {.x = 2, .samples = high, .count = 6},
                                      {.x = 1, .group = 1, .samples = flat, .count = 7},
                                      {.x = 3, .group = 1, .samples = flat, .count = 7}};
    assert_near(rg_slope_resampled(points, 2).median, log(10.0 / 2) / 2, 1e-12);
    assert_near(rg_slope_resampled(points, 4).median, log(10.0 / 2) / 4, 1e-12);
    const struct rg_interval level = rg_slope_resampled(points + 2, 2);
    assert_true(level.median == 0 && level.low == 0 && level.high == 0);
    points[3].count = 5; // of one point alone
    const struct rg_interval few = rg_slope_resampled(points, 4);
    assert_true(isfinite(few.median) && isnan(few.low) && isnan(few.high));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_weights),  cmocka_unit_test(test_coverage),
        cmocka_unit_test(test_drift),    cmocka_unit_test(test_no_interval),
        cmocka_unit_test(test_symmetry), cmocka_unit_test(test_slope_of_medians),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
