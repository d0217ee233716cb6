// Claims about tables: samples whose order is known are judged so, and noise is left undecided.
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

enum { ROWS = 5, SAMPLES = 10, TRIALS = 200 };

static double chance(uint32_t *x)
{
    *x = *x * 1664525u + 1013904223u;
    return ((double)(*x >> 8) + 0.5) * 0x1p-24;
}

// --- made-up tables ---

// A result of one device, whose row i has samples about ms[i], off by up to `noise` of it.
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
            r->sample_count = SAMPLES;
            for (int i = 0; i < SAMPLES; i++)
                r->samples_ms[i] = (v ? other_ms : ms)[row] * (1 + noise * (2 * chance(x) - 1));
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

// How often each verdict is given where rows truly take these times.
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
        assert_in_range(counts[verdict], (int)((share)*TRIALS), TRIALS);                           \
    } while (0)

static const double rising[ROWS] = {10, 11, 12.1, 13.3, 14.6}, level[ROWS] = {10, 10, 10, 10, 10};
static const double turned[ROWS] = {10, 11, 10, 13.3, 14.6};

static void test_rows_that_fall(void **state)
{
    (void)state;
    const struct rg_claim falls = claim_of(RG_CLAIM_FALLS), order = claim_of(RG_CLAIM_ORDER);
    EXPECT(falls, rising, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    EXPECT(falls, turned, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    EXPECT(falls, level, 0.05, RG_CLAIM_UNDECIDED, 0.95);
    EXPECT(order, rising, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    EXPECT(order, turned, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    EXPECT(order, level, 0.05, RG_CLAIM_UNDECIDED, 0.95);
    // Noise hides the order: whatever is decided, is decided rightly.
    int counts[RG_CLAIM_VERDICTS];
    count_verdicts(&falls, rising, 0.6, counts);
    assert_at_most(counts[RG_CLAIM_NOT_REPRODUCED], TRIALS / 20);
    assert_above(counts[RG_CLAIM_UNDECIDED], TRIALS / 2);
    count_verdicts(&falls, turned, 0.6, counts);
    assert_at_most(counts[RG_CLAIM_REPRODUCED], TRIALS / 20);
}

static void test_ratios(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO), alike = claim_of(RG_CLAIM_ALIKE);
    ratio.least = 1.3;
    EXPECT(ratio, rising, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    ratio.least = 1.46; // as it is
    EXPECT(ratio, rising, 0.05, RG_CLAIM_UNDECIDED, 0.93);
    ratio.least = 1.6;
    EXPECT(ratio, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    alike.most = 1.1;
    EXPECT(alike, level, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    EXPECT(alike, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    struct rg_claim apart = claim_of(RG_CLAIM_APART);
    apart.least = 1.1;
    EXPECT(apart, level, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    EXPECT(apart, rising, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    // What speaks against rows that are apart speaks for rows that are alike.
    uint32_t x = 3;
    struct rg_result result;
    make_result(&result, rising, level, 0.05, &x);
    alike.most = apart.least;
    const struct rg_judgement a = rg_claim_judge(&alike, &result, 0);
    const struct rg_judgement b = rg_claim_judge(&apart, &result, 0);
    assert_equals(a.against, b.in_favour);
    assert_equals(a.in_favour, b.against);
    assert_above(a.against, a.in_favour);
    rg_result_free(&result);
}

// Print says 100.5 and 96.5, so a ratio is known to 0.05 / 100.5 + 0.05 / 96.5. Where that hides on
// which side of it the rows are, nothing is decided, however little they scatter.
static void test_ratios_near_print(void **state)
{
    (void)state;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    const double margin = 0.05 / 100.5 + 0.05 / 96.5;
    ratio.least = 1.46 / (1 + 1.1 * margin);
    EXPECT(ratio, rising, 1e-6, RG_CLAIM_REPRODUCED, 1);
    ratio.least = 1.46 / (1 + 0.9 * margin);
    EXPECT(ratio, rising, 1e-6, RG_CLAIM_UNDECIDED, 1);
    ratio.least = 1.46 / (1 - 0.9 * margin);
    EXPECT(ratio, rising, 1e-6, RG_CLAIM_UNDECIDED, 1);
    ratio.least = 1.46 / (1 - 1.1 * margin);
    EXPECT(ratio, rising, 1e-6, RG_CLAIM_NOT_REPRODUCED, 1);
    struct rg_claim alike = claim_of(RG_CLAIM_ALIKE);
    alike.most = 1.46 / (1 - 1.5 * margin);
    EXPECT(alike, rising, 1e-6, RG_CLAIM_REPRODUCED, 1);
    alike.most = 1.46 / (1 - 0.5 * margin);
    EXPECT(alike, rising, 1e-6, RG_CLAIM_UNDECIDED, 1);
    alike.most = 1.46 / (1 + 1.5 * margin);
    EXPECT(alike, rising, 1e-6, RG_CLAIM_NOT_REPRODUCED, 1);
}

// Of fewer than six samples no claim is decided, however far rows are apart.
static void test_few_samples(void **state)
{
    (void)state;
    static const double far[ROWS] = {1, 10, 100, 1000, 10000};
    static const enum rg_claim_test tests[] = {
        RG_CLAIM_FALLS, RG_CLAIM_ORDER,  RG_CLAIM_RATIO,    RG_CLAIM_ALIKE,   RG_CLAIM_APART,
        RG_CLAIM_RATE,  RG_CLAIM_FASTER, RG_CLAIM_EXPONENT, RG_CLAIM_OPTIMUM, RG_CLAIM_SLOWEST};
    for (size_t i = 0; i < sizeof(tests) / sizeof(tests[0]); i++) {
        struct rg_claim claim = claim_of(tests[i]);
        struct rg_result result;
        uint32_t x = 9;
        claim.least = tests[i] == RG_CLAIM_EXPONENT ? -99 : 1e-4;
        claim.most = 99;
        claim.knee = 1;
        make_result(&result, far, level, 0.01, &x);
        const bool decided = rg_claim_judge(&claim, &result, 0).verdict < RG_CLAIM_UNDECIDED;
        assert_true(decided);
        for (int row = 0; row < ROWS; row++)
            for (int v = 0; v < 2; v++)
                rg_result_at(&result, (struct rg_place){.row = row, .variant = v})->sample_count =
                    5;
        const struct rg_judgement j = rg_claim_judge(&claim, &result, 0);
        assert_int_equal(j.verdict, RG_CLAIM_UNDECIDED);
        rg_result_free(&result);
    }
}

// Rows whose difference is within that of the machine's speed while they were measured are left
// open.
static void test_drift(void **state)
{
    (void)state;
    const struct rg_claim falls = claim_of(RG_CLAIM_FALLS);
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    struct rg_result result;
    uint32_t x = 9;
    make_result(&result, rising, level, 0.01, &x);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    struct rg_record *last = rg_result_at(&result, (struct rg_place){.row = ROWS - 1});
    for (int row = 0; row < ROWS; row++) {
        struct rg_record *r = rg_result_at(&result, (struct rg_place){.row = row});
        r->calibration_begin_ms = r->calibration_end_ms = 2;
    }
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    last->calibration_begin_ms = last->calibration_end_ms =
        2 * 1.12; // the row is 1.098 times as slow
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    ratio.least = 1.55; // the rows are 1.46 apart
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    last->calibration_begin_ms = last->calibration_end_ms = 2;
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).verdict, RG_CLAIM_NOT_REPRODUCED);
    rg_result_free(&result);
}

// Nor where the second variant of a claim has fewer.
static void test_few_samples_of_the_other(void **state)
{
    (void)state;
    struct rg_claim faster = claim_of(RG_CLAIM_FASTER);
    struct rg_result result;
    uint32_t x = 9;
    faster.least = 2;
    make_result(&result, rising, level, 0.01, &x);
    assert_int_equal(rg_claim_judge(&faster, &result, 0).verdict, RG_CLAIM_NOT_REPRODUCED);
    for (int row = 0; row < ROWS; row++)
        rg_result_at(&result, (struct rg_place){.row = row, .variant = 1})->sample_count = 5;
    assert_int_equal(rg_claim_judge(&faster, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    rg_result_free(&result);
}

// Of several rows each may be too slow by chance: seven that make exactly what is due are seldom
// found too slow, and the probability behind a verdict is told.
static void test_rates_jointly(void **state)
{
    (void)state;
    struct rg_claim rate = claim_of(RG_CLAIM_RATE);
    int counts[RG_CLAIM_VERDICTS];
    rate.least = 100;
    count_verdicts(&rate, level, 0.05, counts);
    assert_at_most(counts[RG_CLAIM_NOT_REPRODUCED], TRIALS / 20);
    assert_at_most(counts[RG_CLAIM_REPRODUCED], TRIALS / 20);
    struct rg_result result;
    uint32_t x = 9;
    make_result(&result, level, level, 0.01, &x);
    rate.least = 90;
    assert_below(fabs(rg_claim_judge(&rate, &result, 0).against - 1.0 / 1024), 1e-12);
    rate.least = 110;
    assert_below(fabs(rg_claim_judge(&rate, &result, 0).in_favour - 5.0 / 1024), 1e-12);
    rg_result_free(&result);
}

static void test_variants_rates_and_powers(void **state)
{
    (void)state;
    struct rg_claim faster = claim_of(RG_CLAIM_FASTER), rate = claim_of(RG_CLAIM_RATE);
    static const double quick[ROWS] = {9, 9, 9, 9, 9};
    faster.least = 1;
    EXPECT(faster, quick, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    EXPECT(faster, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    EXPECT(faster, level, 0.05, RG_CLAIM_UNDECIDED, 0.95);
    rate.least = 60;
    EXPECT(rate, rising, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    rate.least = 1000 / 14.6; // as it is
    EXPECT(rate, rising, 0.05, RG_CLAIM_UNDECIDED, 0.93);
    rate.least = 75;
    EXPECT(rate, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    faster.last = 1; // one pair: either way is found by chance once in 40 times
    EXPECT(faster, level, 0.05, RG_CLAIM_UNDECIDED, 0.94);
    struct rg_claim optimum = claim_of(RG_CLAIM_OPTIMUM);
    static const double valley[ROWS] = {12, 11, 9, 9, 12};
    optimum.knee = 3;
    EXPECT(optimum, valley, 0.05, RG_CLAIM_UNDECIDED, 0.95);
    optimum.until = 4; // either of the two
    EXPECT(optimum, valley, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    optimum.knee = optimum.until = 2;
    EXPECT(optimum, valley, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    EXPECT(optimum, level, 0.05, RG_CLAIM_UNDECIDED, 0.95);
    struct rg_claim crosses = claim_of(RG_CLAIM_CROSSES); // the other variant takes 10
    static const double falling[ROWS] = {12, 11, 9, 9, 9};
    crosses.knee = 3;
    EXPECT(crosses, falling, 0.05, RG_CLAIM_UNDECIDED, 1); // print has both alike, and says neither
    struct rg_claim slowest = claim_of(RG_CLAIM_SLOWEST);
    static const double peak[ROWS] = {10, 11, 14, 11, 12};
    slowest.knee = 3;
    EXPECT(slowest, peak, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    EXPECT(slowest, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    EXPECT(slowest, level, 0.05, RG_CLAIM_UNDECIDED, 0.95);
    struct rg_claim power = claim_of(RG_CLAIM_EXPONENT);
    static const double square[ROWS] = {10, 40, 90, 160, 250};
    power.least = -2.2;
    power.most = -1.8;
    EXPECT(power, square, 0.05, RG_CLAIM_REPRODUCED, 0.99);
    EXPECT(power, rising, 0.05, RG_CLAIM_NOT_REPRODUCED, 0.99);
    power.least = -2; // as it is
    EXPECT(power, square, 0.05, RG_CLAIM_UNDECIDED, 0.95);
}

// --- what is not judged ---

static void draw_particles(struct rg_record *r, double printed, double drawn)
{
    r->published_count = 2;
    r->fact_count = 1;
    rg_named_set_number(&r->published[1], "particles", printed);
    rg_named_set_number(&r->facts[0], "particles", drawn);
}

static void test_rows_that_are_missing_or_other_work(void **state)
{
    (void)state;
    struct rg_result result;
    uint32_t x = 5;
    const struct rg_claim falls = claim_of(RG_CLAIM_FALLS);
    make_result(&result, rising, level, 0.01, &x);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).rows, ROWS);
    struct rg_claim power = claim_of(RG_CLAIM_EXPONENT), rate = claim_of(RG_CLAIM_RATE),
                    apart = claim_of(RG_CLAIM_APART);
    power.least = -99;
    rate.least = apart.least = 99; // neither holds
    power.most = 99;
    assert_int_equal(rg_claim_judge(&apart, &result, 0).verdict, RG_CLAIM_NOT_REPRODUCED);
    rg_result_drop_row(&result, 2);
    // What each row must bear out, some do not; that one does not, any of them says.
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    assert_int_equal(rg_claim_judge(&rate, &result, 0).verdict, RG_CLAIM_NOT_REPRODUCED);
    assert_int_equal(rg_claim_judge(&apart, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    assert_int_equal(rg_claim_judge(&power, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    rate.least = 1;
    assert_int_equal(rg_claim_judge(&rate, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).rows, ROWS - 1);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).rows_needed, ROWS);
    rg_result_free(&result);
    // A row between that is other work is left out, however slow it is; one that the claim needs
    // is not.
    make_result(&result, rising, level, 0.01, &x);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
    struct rg_record *between = rg_result_at(&result, (struct rg_place){.row = 3});
    for (int i = 0; i < between->sample_count; i++)
        between->samples_ms[i] *= 100;
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_NOT_REPRODUCED);
    draw_particles(between, 1000, 1210);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_REPRODUCED);
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
    rg_result_drop_row(&result, 0);
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    result.work_count = 1;
    snprintf(result.works[0].saves, RG_TITLE_SIZE, "half of it is left out");
    assert_int_equal(rg_claim_judge(&falls, &result, 0).verdict, RG_CLAIM_OTHER_WORK);
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
    rg_result_drop_row(&result, 1);
    assert_int_equal(rg_claim_judge(&knee, &result, 0).verdict, RG_CLAIM_UNDECIDED);
    struct rg_claim alike = claim_of(RG_CLAIM_ALIKE);
    alike.most = 1.02; // print says 1.04
    assert_true(rg_claim_judge(&alike, &result, 0).print_contradicts);
    // However the rows were measured, or not.
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
    assert_false(rg_claim_judge(&crosses, &result, 0).print_contradicts); // it is alike throughout
    rg_result_at(&result, (struct rg_place){.row = 2, .variant = 1})->published[0].number = 200;
    assert_true(rg_claim_judge(&crosses, &result, 0).print_contradicts);
    rg_result_free(&result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rows_that_fall),
        cmocka_unit_test(test_ratios),
        cmocka_unit_test(test_ratios_near_print),
        cmocka_unit_test(test_few_samples),
        cmocka_unit_test(test_drift),
        cmocka_unit_test(test_few_samples_of_the_other),
        cmocka_unit_test(test_rates_jointly),
        cmocka_unit_test(test_variants_rates_and_powers),
        cmocka_unit_test(test_rows_that_are_missing_or_other_work),
        cmocka_unit_test(test_a_knee_and_print),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
