// Claims about tables: launches with a known truth get the right verdict, and noise leaves it open.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/claims/claim.h"
#include "tests/tools/expect.h"

enum { ROWS = 5, LAUNCHES = 192, TRIALS = 100 };

static double chance(uint32_t *x)
{
    *x = *x * 1664525u + 1013904223u;
    return ((double)(*x >> 8) + 0.5) * 0x1p-24;
}

// --- made-up tables ---

// A result of one device. Row i has launches about ms[i], off by up to `noise` of it.
static void make_result(struct rg_result *result, const double ms[ROWS],
                        const double other_ms[ROWS], double noise, uint32_t *x)
{
    memset(result, 0, sizeof(*result));
    snprintf(result->table, sizeof(result->table), "made-up");
    snprintf(result->hardware, sizeof(result->hardware), "a machine");
    snprintf(result->truth, sizeof(result->truth), "limits=off");
    snprintf(result->variants[0], RG_NAME_SIZE, "full");
    snprintf(result->variants[1], RG_NAME_SIZE, "other");
    result->variant_count = 2;
    result->device_count = 1;
    result->last_row = ROWS - 1;
    for (int row = 0; row < ROWS; row++) {
        assert_true(rg_result_add_row(result, row));
        for (int v = 0; v < 2; v++) {
            struct rg_record *r = rg_result_at(result, (struct rg_place){.row = row, .variant = v});
            r->outcome = RG_OK;
            r->row_count = r->published_count = 1;
            snprintf(r->row[0].name, sizeof(r->row[0].name), "size");
            r->row[0].number = row + 1;
            snprintf(r->published[0].name, sizeof(r->published[0].name), "fps");
            r->published[0].number = 100.5 - row;
            r->sample_count = 1;
            r->samples_ms[0] = (v ? other_ms : ms)[row];
            r->launch_count = LAUNCHES;
            for (int i = 0; i < LAUNCHES; i++)
                r->launches[i] = (struct rg_launch){.number = i + 1,
                                                    .ms = (v ? other_ms : ms)[row] *
                                                          (1 + noise * (2 * chance(x) - 1))};
            rg_record_settle(r);
        }
    }
}

static struct rg_claim claim_of(enum rg_claim_test test)
{
    return (struct rg_claim){.table = "made-up",
                             .variant = "full",
                             .other = "other",
                             .test = test,
                             .first = 1,
                             .last = ROWS};
}

// Counts each verdict over trials with these true times.
static void count_verdicts(const struct rg_claim *claim, const double ms[ROWS], double noise,
                           int counts[RG_CLAIM_VERDICTS])
{
    static const double other[ROWS] = {10, 10, 10, 10, 10};
    uint32_t x = 11;
    memset(counts, 0, RG_CLAIM_VERDICTS * sizeof(*counts));
    for (int trial = 0; trial < TRIALS; trial++) {
        struct rg_result result;
        make_result(&result, ms, other, noise, &x);
        counts[rg_claim_judge(claim, &result, 0).verdict]++;
        rg_result_free(&result);
    }
}

#define EXPECT(claim, ms, noise, verdict, share)                                                   \
    do {                                                                                           \
        int counts[RG_CLAIM_VERDICTS];                                                             \
        count_verdicts(&(claim), ms, noise, counts);                                               \
        assert_between(counts[verdict], (int)((share)*TRIALS), TRIALS);                            \
    } while (0)

static const double rising[ROWS] = {10, 11, 12.1, 13.3, 14.6}, level[ROWS] = {10, 10, 10, 10, 10};
static const double turned[ROWS] = {10, 11.5, 10, 13.3, 14.6};

static void test_rows_that_fall(void **state)
{
    (void)state;
    const struct rg_claim falls = claim_of(RG_CLAIM_FALLS), order = claim_of(RG_CLAIM_ORDER);
    EXPECT(falls, rising, 0.05, RG_CLAIM_REPRODUCED, 1);
    EXPECT(falls, turned, 0.01, RG_CLAIM_NOT_REPRODUCED, 1); // 1.15, but 1.1 is allowed
    EXPECT(order, rising, 0.05, RG_CLAIM_REPRODUCED, 1);
    EXPECT(order, turned, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    EXPECT(order, level, 0.05, RG_CLAIM_AT_BOUND, 0.98);
    // A row may be a tenth faster than the one before it, and no more, whatever the whole fall is.
    static const double dip[ROWS] = {10, 11.5, 11, 13.3, 14.6},
                        deep[ROWS] = {10, 13, 11.1, 13.3, 14.6};
    EXPECT(falls, dip, 0.01, RG_CLAIM_REPRODUCED, 1);
    EXPECT(falls, deep, 0.01, RG_CLAIM_NOT_REPRODUCED, 1);
    // The whole fall counts, however small a slope many launches would find.
    static const double faint[ROWS] = {10, 10, 10.01, 10.01, 10.02},
                        climbs[ROWS] = {11, 10.8, 10.6, 10.4, 10.2};
    EXPECT(falls, faint, 0.001, RG_CLAIM_NOT_REPRODUCED, 1);
    EXPECT(falls, climbs, 0.01, RG_CLAIM_NOT_REPRODUCED, 1);
    // Noise hides the order, but no verdict is wrong.
    int counts[RG_CLAIM_VERDICTS];
    count_verdicts(&falls, rising, 0.9, counts);
    assert_int_equal(counts[RG_CLAIM_NOT_REPRODUCED], 0);
    count_verdicts(&order, turned, 0.9, counts);
    assert_int_equal(counts[RG_CLAIM_REPRODUCED], 0);
    assert_above(counts[RG_CLAIM_UNDECIDED], TRIALS / 2);
}

static void test_ratios(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO), alike = claim_of(RG_CLAIM_ALIKE);
    ratio.least = 1.3;
    EXPECT(ratio, rising, 0.05, RG_CLAIM_REPRODUCED, 1);
    ratio.least = 1.46; // the true ratio
    EXPECT(ratio, rising, 0.05, RG_CLAIM_AT_BOUND, 0.98);
    ratio.least = 1.6;
    EXPECT(ratio, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    alike.most = 1.1;
    EXPECT(alike, level, 0.05, RG_CLAIM_REPRODUCED, 1);
    EXPECT(alike, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    struct rg_claim apart = claim_of(RG_CLAIM_APART);
    apart.least = 1.1;
    EXPECT(apart, level, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    EXPECT(apart, rising, 0.05, RG_CLAIM_REPRODUCED, 1);
    // TIMES is one equivalence with two bounds.
    struct rg_claim times = claim_of(RG_CLAIM_TIMES);
    times.least = 1.4;
    times.most = 1.52;
    EXPECT(times, rising, 0.01, RG_CLAIM_REPRODUCED, 1);
    times.most = 1.46;
    EXPECT(times, rising, 0.01, RG_CLAIM_AT_BOUND, 0.98);
    times.most = 1.42;
    EXPECT(times, rising, 0.01, RG_CLAIM_NOT_REPRODUCED, 1);
    times.least = 1.5;
    times.most = 2;
    EXPECT(times, rising, 0.01, RG_CLAIM_NOT_REPRODUCED, 1);
}

// --- launches ---

// Disturbed launches do not count, whatever their times. The reason gives their number.
static void test_disturbed_launches(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    struct rg_result result;
    uint32_t x = 9;
    ratio.least = 1.3;
    make_result(&result, rising, level, 0.01, &x);
    struct rg_record *last = rg_result_at(&result, (struct rg_place){.row = ROWS - 1});
    for (int i = 0; i < 12; i++)
        last->launches[i].ms = 1; // faster than any other
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    for (int i = 0; i < 12; i++)
        last->launches[i].others = 0.051;
    const struct rg_judgement j = rg_claim_judge(&ratio, &result, 0);
    assert_int_equal(j.verdict, RG_CLAIM_REPRODUCED);
    assert_int_equal(j.disturbed, 12);
    assert_int_equal(j.launches, 24);
    assert_non_null(strstr(j.why, "24 launches, and 12 that others disturbed"));
    for (int i = 0; i < 12; i++)
        last->launches[i].others = 0.05;
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).disturbed, 0);
    rg_result_free(&result);
}

// A launch counts only if it has all cells of the claim.
static void test_launches_that_are_not_whole(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    struct rg_result result;
    uint32_t x = 9;
    ratio.least = 1.3;
    make_result(&result, rising, level, 0.01, &x);
    struct rg_record *last = rg_result_at(&result, (struct rg_place){.row = ROWS - 1});
    last->launch_count = 23;
    const struct rg_judgement j = rg_claim_judge(&ratio, &result, 0);
    assert_int_equal(j.verdict, RG_CLAIM_UNDECIDED);
    assert_int_equal(j.launches, 23);
    assert_int_equal(j.more, 1);
    last->launches[22].number = LAUNCHES; // the other row's launch 192 counts with it
    last->launch_count = 24;
    last->launches[23].number = LAUNCHES + 1;
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).more, 1);
    rg_result_free(&result);
}

// An open verdict says how many more launches would probably decide it, and how long these take.
static void test_what_an_open_verdict_would_take(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    struct rg_result result;
    uint32_t x = 9;
    ratio.least = 1.4;
    make_result(&result, rising, level, 0.3, &x);
    for (int row = 0; row < ROWS; row++) {
        struct rg_record *r = rg_result_at(&result, (struct rg_place){.row = row});
        r->launch_count = 12;
        for (int i = 0; i < 12; i++)
            r->launches[i].seconds = 450;
    }
    const struct rg_judgement j = rg_claim_judge(&ratio, &result, 0);
    assert_int_equal(j.verdict, RG_CLAIM_UNDECIDED);
    assert_int_equal(j.more, 12);
    assert_equals(j.launch_s, 900);
    assert_at_least(j.needed, 96);
    char left[80];
    snprintf(left, sizeof(left), "; some %d more would probably decide, in ",
             j.needed - j.launches);
    assert_non_null(strstr(j.why, left));
    rg_result_free(&result);
}

// Without launches there is no verdict, only what the medians show.
static void test_one_launch(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    static const struct {
        double least;
        enum rg_claim_figures figures;
    } cases[] = {{1.3, RG_FIGURES_FIT}, {1.45, RG_FIGURES_NEAR}, {1.6, RG_FIGURES_MISS}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_result result;
        uint32_t x = 9;
        ratio.least = cases[i].least;
        make_result(&result, rising, level, 0, &x);
        assert_int_equal(rg_claim_judge(&ratio, &result, 0).figures, cases[i].figures);
        for (int row = 0; row < ROWS; row++)
            rg_result_at(&result, (struct rg_place){.row = row})->launch_count = 0;
        const struct rg_judgement j = rg_claim_judge(&ratio, &result, 0);
        assert_int_equal(j.verdict, RG_CLAIM_ONE_LAUNCH);
        assert_int_equal(j.figures, cases[i].figures);
        assert_int_equal(j.launches, 0);
        rg_result_free(&result);
    }
}

// If a bound is our own, the reason says so and at which value the verdict turns.
static void test_bounds_of_ours(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    struct rg_result result;
    uint32_t x = 9;
    ratio.least = 1.2;
    make_result(&result, rising, level, 1e-6, &x);
    assert_null(strstr(rg_claim_judge(&ratio, &result, 0).why, "ours"));
    ratio.is_ours = true;
    assert_non_null(strstr(rg_claim_judge(&ratio, &result, 0).why,
                           "the bound is ours, and the verdict turns at 1.46"));
    rg_result_free(&result);
}

static void test_variants_rates_and_powers(void **state)
{
    (void)state;
    struct rg_claim faster = claim_of(RG_CLAIM_FASTER), rate = claim_of(RG_CLAIM_RATE);
    static const double quick[ROWS] = {9, 9, 9, 9, 9};
    faster.least = 1;
    EXPECT(faster, quick, 0.05, RG_CLAIM_REPRODUCED, 1);
    EXPECT(faster, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    EXPECT(faster, level, 0.05, RG_CLAIM_AT_BOUND, 0.98);
    rate.least = 60;
    EXPECT(rate, rising, 0.05, RG_CLAIM_REPRODUCED, 1);
    rate.least = 1000 / 14.6; // the true rate
    EXPECT(rate, rising, 0.05, RG_CLAIM_AT_BOUND, 0.98);
    rate.least = 75;
    EXPECT(rate, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    struct rg_claim optimum = claim_of(RG_CLAIM_OPTIMUM);
    static const double valley[ROWS] = {12, 11, 9, 9, 12};
    optimum.knee = 3;
    EXPECT(optimum, valley, 0.05, RG_CLAIM_AT_BOUND, 0.98); // row 4 is as fast
    optimum.until = 4;                                      // either row may be the fastest
    EXPECT(optimum, valley, 0.05, RG_CLAIM_REPRODUCED, 1);
    optimum.knee = optimum.until = 2;
    EXPECT(optimum, valley, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    EXPECT(optimum, level, 0.05, RG_CLAIM_AT_BOUND, 0.98);
    struct rg_claim crosses = claim_of(RG_CLAIM_CROSSES); // the other variant takes 10
    static const double falling[ROWS] = {12, 11, 9, 9, 9};
    crosses.knee = 3;
    EXPECT(crosses, falling, 0.05, RG_CLAIM_NOT_SEEN, 1); // in print they are alike
    struct rg_claim slowest = claim_of(RG_CLAIM_SLOWEST);
    static const double peak[ROWS] = {10, 11, 14, 11, 12};
    slowest.knee = 3;
    EXPECT(slowest, peak, 0.05, RG_CLAIM_REPRODUCED, 1);
    EXPECT(slowest, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    EXPECT(slowest, level, 0.05, RG_CLAIM_AT_BOUND, 0.98);
    struct rg_claim power = claim_of(RG_CLAIM_EXPONENT);
    static const double square[ROWS] = {10, 40, 90, 160, 250};
    power.least = -2.2;
    power.most = -1.8;
    EXPECT(power, square, 0.05, RG_CLAIM_REPRODUCED, 1);
    EXPECT(power, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 1);
    power.least = -2; // the true power
    EXPECT(power, square, 0.02, RG_CLAIM_AT_BOUND, 0.98);
}

// --- claims that are not judged ---

static void draw_particles(struct rg_record *r, double printed, double drawn)
{
    r->published_count = 2;
    r->fact_count = 1;
    rg_named_set_number(&r->published[1], "particles", printed);
    rg_named_set_number(&r->facts[0], "particles", drawn);
}

static void test_rows_that_are_missing(void **state)
{
    (void)state;
    struct rg_result result;
    uint32_t x = 5;
    struct rg_claim falls = claim_of(RG_CLAIM_FALLS), rate = claim_of(RG_CLAIM_RATE),
                    ratio = claim_of(RG_CLAIM_RATIO);
    make_result(&result, rising, level, 0.01, &x);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).rows, ROWS);
    rate.least = 99; // holds in no row
    ratio.least = 1.3;
    rg_result_drop_row(&result, 2);
    // A claim with missing rows gets no verdict, even if the others would refute it.
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_NOT_SEEN);
    assert_int_equal(rg_claim_judge(&rate, &result, 0).verdict, RG_CLAIM_NOT_SEEN);
    assert_int_equal(rg_claim_judge(&rate, &result, 0).figures, RG_FIGURES_NONE);
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).verdict,
                     RG_CLAIM_REPRODUCED); // it needs two rows only
    falls.other = "none";
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_NOT_SEEN);
    rg_result_at(&result, (struct rg_place){.row = 0})->outcome = RG_ERROR;
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).verdict, RG_CLAIM_NOT_SEEN);
    rg_result_free(&result);
}

static void slow_down(struct rg_record *record, double times)
{
    for (int i = 0; i < record->launch_count; i++)
        record->launches[i].ms *= times;
}

static void test_other_work(void **state)
{
    (void)state;
    struct rg_result result;
    uint32_t x = 5;
    const struct rg_claim falls = claim_of(RG_CLAIM_FALLS);
    // A row in between with other work is left out, however slow it is. A row that the claim needs
    // makes the whole claim other work.
    make_result(&result, rising, level, 0.01, &x);
    struct rg_record *between = rg_result_at(&result, (struct rg_place){.row = 3});
    slow_down(between, 100);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_NOT_REPRODUCED);
    draw_particles(between, 1000, 1210);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).rows, ROWS - 1);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).rows_needed, ROWS);
    struct rg_record *needed = rg_result_at(&result, (struct rg_place){.row = 0});
    draw_particles(needed, 1000, 1190);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    draw_particles(needed, 1000, 1210);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_OTHER_WORK);
    draw_particles(needed, 1210, 1000);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_OTHER_WORK);
    draw_particles(needed, 1000, 1000);
    snprintf(result.changed, sizeof(result.changed), "seed=2");
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_OTHER_WORK);
    *result.changed = 0;
    result.work_count = 1;
    snprintf(result.works[0].saves, RG_TITLE_SIZE, "half of it is left out");
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_OTHER_WORK);
    rg_result_free(&result);
}

// A rate is claimed for the whole work, not for smaller pictures or quick settings.
static void test_rates_of_less_work(void **state)
{
    (void)state;
    struct rg_result result;
    uint32_t x = 5;
    struct rg_claim rate = claim_of(RG_CLAIM_RATE), falls = claim_of(RG_CLAIM_FALLS);
    rate.least = 10;
    make_result(&result, rising, level, 0.01, &x);
    assert_int_equal(rg_claim_judge(&rate, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    result.size_divisor = 4;
    assert_int_equal(rg_claim_judge(&rate, &result, 0).verdict, RG_CLAIM_OTHER_WORK);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    result.size_divisor = 1;
    snprintf(result.quick, sizeof(result.quick), "city=small");
    assert_int_equal(rg_claim_judge(&rate, &result, 0).verdict, RG_CLAIM_OTHER_WORK);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    result.full = true;
    assert_int_equal(rg_claim_judge(&rate, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    rg_result_free(&result);
}

static void test_a_knee_and_print(void **state)
{
    (void)state;
    struct rg_result result;
    uint32_t x = 5;
    struct rg_claim knee = claim_of(RG_CLAIM_FLATTENS), apart = claim_of(RG_CLAIM_APART);
    const double errors[ROWS] = {0.5, 0.28, 0.11, 0.1, 0.09};
    make_result(&result, rising, level, 0.01, &x);
    for (int row = 0; row < ROWS; row++)
        rg_result_at(&result, (struct rg_place){.row = row})->truth_error =
            (struct rg_truth_error){.outcome = RG_OK, .flip_mask_mean = errors[row]};
    knee.least = 3;
    knee.knee = 3;
    assert_int_equal(rg_claim_judge(&knee, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    knee.knee = 2;
    assert_int_equal(rg_claim_judge(&knee, &result, 0).verdict, RG_CLAIM_NOT_REPRODUCED);
    knee.least = 0.22 / 0.19;
    assert_int_equal(rg_claim_judge(&knee, &result, 0).verdict, RG_CLAIM_AT_BOUND);
    rg_result_drop_row(&result, 1);
    assert_int_equal(rg_claim_judge(&knee, &result, 0).verdict, RG_CLAIM_NOT_SEEN);
    struct rg_claim alike = claim_of(RG_CLAIM_ALIKE);
    alike.most = 1.02; // print has 1.04
    assert_true(rg_claim_judge(&alike, &result, 0).print_contradicts);
    // Print does not depend on how the rows were measured.
    rg_result_at(&result, (struct rg_place){.row = 0})->outcome = RG_ERROR;
    assert_true(rg_claim_judge(&alike, &result, 0).print_contradicts);
    alike.most = 1.2;
    assert_false(rg_claim_judge(&alike, &result, 0).print_contradicts);
    apart.least = 1.2;
    assert_true(rg_claim_judge(&apart, &result, 0).print_contradicts);
    apart.least = 1.02;
    assert_false(rg_claim_judge(&apart, &result, 0).print_contradicts);
    struct rg_claim optimum = claim_of(RG_CLAIM_OPTIMUM), slowest = claim_of(RG_CLAIM_SLOWEST);
    optimum.knee = 1; // print falls by 1 from row to row
    slowest.knee = ROWS;
    assert_false(rg_claim_judge(&optimum, &result, 0).print_contradicts);
    assert_false(rg_claim_judge(&slowest, &result, 0).print_contradicts);
    optimum.knee = slowest.knee = 3;
    assert_true(rg_claim_judge(&optimum, &result, 0).print_contradicts);
    assert_true(rg_claim_judge(&slowest, &result, 0).print_contradicts);
    struct rg_claim crosses = claim_of(RG_CLAIM_CROSSES);
    crosses.knee = 3;
    assert_false(rg_claim_judge(&crosses, &result, 0).print_contradicts); // print is alike
    rg_result_at(&result, (struct rg_place){.row = 2, .variant = 1})->published[0].number = 200;
    assert_true(rg_claim_judge(&crosses, &result, 0).print_contradicts);
    rg_result_free(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_that_fall),
        cmocka_unit_test(test_ratios),
        cmocka_unit_test(test_disturbed_launches),
        cmocka_unit_test(test_launches_that_are_not_whole),
        cmocka_unit_test(test_what_an_open_verdict_would_take),
        cmocka_unit_test(test_one_launch),
        cmocka_unit_test(test_bounds_of_ours),
        cmocka_unit_test(test_variants_rates_and_powers),
        cmocka_unit_test(test_rows_that_are_missing),
        cmocka_unit_test(test_other_work),
        cmocka_unit_test(test_rates_of_less_work),
        cmocka_unit_test(test_a_knee_and_print),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
