// The sentence that tells a verdict: what was compared, how it came out, what was needed, and why a
// claim is not judged.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/claims/claim.h"
#include "tests/tools/expect.h"

enum { ROWS = 5 };

// --- a made-up table ---

// Two variants with these times, in each launch the same but for less than is printed. Printed
// rates fall from row to row.
static void make(struct rg_result *result, double ms[2][ROWS], int launches)
{
    static const double fps[2][ROWS] = {{100, 80, 50, 40, 20}, {90, 85, 50, 60, 30}};
    uint32_t x = 1;
    *result = (struct rg_result){.table = "made-up",
                                 .truth = "limits=off",
                                 .variants = {"full", "other"},
                                 .variant_count = 2,
                                 .device_count = 1,
                                 .last_row = ROWS - 1};
    for (int row = 0; row < ROWS; row++)
        assert_true(rg_result_add_row(result, row));
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        struct rg_record *r = rg_result_at(result, at);
        rg_named_set_number(&r->row[r->row_count++], "size", at.row + 1);
        rg_named_set_number(&r->published[r->published_count++], "fps", fps[at.variant][at.row]);
        r->sample_count = 1;
        r->samples_ms[0] = ms[at.variant][at.row];
        r->launch_count = launches;
        for (int i = 0; i < launches; i++) {
            x = x * 1664525u + 1013904223u;
            r->launches[i] = (struct rg_launch){
                .number = i + 1, .ms = ms[at.variant][at.row] * (1 + 1e-15 * x), .seconds = 5};
        }
        rg_record_settle(r);
    }
}

static struct rg_record *record_at(const struct rg_result *result, int row)
{
    return rg_result_at(result, (struct rg_place){.row = row - 1});
}

// The first is 1.5 times as fast as the last.
static double steady[2][ROWS] = {{10, 11, 12, 13, 15}, {12, 12, 12, 12, 12}};

static struct rg_claim claim_of(enum rg_claim_test test)
{
    return (struct rg_claim){
        .table = "made-up", .variant = "full", .test = test, .first = 1, .last = ROWS};
}

static void expect(const struct rg_claim *claim, const struct rg_result *result,
                   enum rg_claim_verdict verdict, const char *why)
{
    const struct rg_judgement j = rg_claim_judge(claim, result, 0);
    assert_string_equal(j.why, why);
    assert_int_equal(j.verdict, verdict);
}

// --- what was compared ---

#define CLAIM(test_, last_, ...)                                                                   \
    {                                                                                              \
        .table = "made-up", .variant = "full", .test = test_, .first = 1, .last = last_,           \
        __VA_ARGS__                                                                                \
    }
#define YES RG_CLAIM_REPRODUCED
#define NO  RG_CLAIM_NOT_REPRODUCED

static struct {
    struct rg_claim claim;
    double ms[2][ROWS];
    enum rg_claim_verdict verdict;
    const char *why;
} told[] = {
    {CLAIM(RG_CLAIM_RATIO, 5, .least = 1.3),
     {{10, 11, 12, 13, 15}},
     YES,
     "size 1 is 1.5 times as fast as size 5 (1.5 to 1.5), needed: at least 1.3; 24 launches"},
    {CLAIM(RG_CLAIM_TIMES, 2, .least = 1.2, .most = 1.8),
     {{10, 15, 1, 1, 1}},
     YES,
     "size 1 is 1.5 times as fast as size 2 (1.5 to 1.5), needed: 1.2 to 1.8; 24 launches"},
    {CLAIM(RG_CLAIM_ALIKE, 3, .most = 2),
     {{10, 11, 12.5, 1, 1}},
     YES,
     "size 1 is 1.25 times as fast as size 3 (1.25 to 1.25), needed: 0.5 to 2; 24 launches"},
    {CLAIM(RG_CLAIM_ALIKE, 3, .most = 1.2),
     {{15, 11, 10, 1, 1}},
     NO,
     "size 1 is 0.667 times as fast as size 3 (0.667 to 0.667), needed: 0.833 to 1.2; 24 launches"},
    {CLAIM(RG_CLAIM_FALLS, 3, .least = 0),
     {{10, 10.2, 10.3, 1, 1}},
     NO,
     "in all size 1 is 1.03 times as fast as size 3 (1.03 to 1.03), needed: at least 1.05; "
     "24 launches"},
    {CLAIM(RG_CLAIM_FALLS, 3, .least = 0),
     {{10, 13, 11, 1, 1}},
     NO,
     "size 2 is 0.846 times as fast as size 3 (0.846 to 0.846), needed: at least 0.909, or 1/1.1, "
     "since a row may be 1.1 times as fast as the row before; 24 launches"},
    // (-2 ln 10 - ln 11.9 + ln 9.95 + 2 ln 10.6) / 10 a row, over four rows.
    {CLAIM(RG_CLAIM_FALLS, 5, .least = 0),
     {{10, 11.9, 10.9, 9.95, 10.6}},
     NO,
     "by the trend size 1 is 0.975 times as fast as size 5 (0.975 to 0.975), needed: at least 1; "
     "48 launches"},
    {CLAIM(RG_CLAIM_ORDER, 3, .least = 0),
     {{10, 12, 11, 1, 1}},
     NO,
     "size 2 is 0.917 times as fast as size 3 (0.917 to 0.917), needed: at least 1; 24 launches"},
    {CLAIM(RG_CLAIM_FASTER, 2, .other = "other", .least = 1.1),
     {{10, 10}, {12, 13}},
     YES,
     "size 1, full is 1.2 times as fast as other (1.2 to 1.2), needed: at least 1.1; 24 launches"},
    {CLAIM(RG_CLAIM_CROSSES, 2, .other = "other", .knee = 2),
     {{12, 10}, {10, 12.5}},
     YES,
     "size 1, other is 1.2 times as fast as full (1.2 to 1.2), needed: at least 1; 24 launches"},
    {CLAIM(RG_CLAIM_RATE, 2, .least = 50),
     {{10, 12.5}},
     YES,
     "size 2: 80 fps (80 to 80), needed: at least 50; 24 launches"},
    {CLAIM(RG_CLAIM_OPTIMUM, 4, .knee = 2, .until = 3),
     {{12, 10, 9, 11, 1}},
     YES,
     "size 3 is 1.22 times as fast as size 4 (1.22 to 1.22), needed: at least 1; 24 launches"},
    {CLAIM(RG_CLAIM_OPTIMUM, 4, .knee = 2, .until = 3),
     {{12, 9, 10, 11, 1}},
     YES,
     "size 2 is 1.22 times as fast as size 4 (1.22 to 1.22), needed: at least 1; 24 launches"},
    {CLAIM(RG_CLAIM_SLOWEST, 3, .knee = 3),
     {{10, 11, 14, 1, 1}},
     YES,
     "size 2 is 1.27 times as fast as size 3 (1.27 to 1.27), needed: at least 1; 24 launches"},
    {CLAIM(RG_CLAIM_EXPONENT, 3, .least = -2.2, .most = -1.8),
     {{10, 40, 90, 1, 1}},
     YES,
     "the power is -2 (-2 to -2), needed: -2.2 to -1.8; 24 launches"},
};

// The part that decides is told: the one that fails most, or holds by least.
static void each_test_says_what_it_compared(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(told) / sizeof(told[0]); i++) {
        struct rg_result result;
        for (int row = 0; row < ROWS; row++)
            for (int v = 0; v < 2; v++)
                told[i].ms[v][row] += told[i].ms[v][row] > 0 ? 0 : 1; // of no claim
        make(&result, told[i].ms, 192);
        expect(&told[i].claim, &result, told[i].verdict, told[i].why);
        rg_result_free(&result);
    }
}

// An axis is the first number of a row, behind names.
static void a_power_is_of_the_first_number(void **state)
{
    (void)state;
    struct rg_result result;
    double ms[2][ROWS] = {{10, 40, 90, 160, 250}, {1, 1, 1, 1, 1}};
    struct rg_claim power = claim_of(RG_CLAIM_EXPONENT);
    power.least = -2.2;
    power.most = -1.8;
    make(&result, ms, 24);
    for (int row = 1; row <= ROWS; row++) {
        struct rg_record *r = record_at(&result, row);
        r->row_count = 3;
        rg_named_set_text(&r->row[0], "camera", "first");
        rg_named_set_number(&r->row[1], "size", row);
        rg_named_set_number(&r->row[2], "seed", 7 - row);
    }
    expect(&power, &result, RG_CLAIM_REPRODUCED,
           "the power is -2 (-2 to -2), needed: -2.2 to -1.8; 24 launches");
    rg_result_free(&result);
}

// --- launches ---

// The last row takes 14 and 16 ms in turn, and the first always 10.
static void make_uneven(struct rg_result *result)
{
    make(result, steady, 24);
    for (int i = 0; i < 24; i++)
        record_at(result, ROWS)->launches[i].ms = i % 2 ? 16 : 14;
}

// The interval's end that faces the bound says where a bound of ours turns the verdict.
static void the_verdict_turns_at_an_end_of_the_interval(void **state)
{
    (void)state;
    static const struct {
        enum rg_claim_test test;
        double least, most;
        const char *turns;
    } rows[] = {{RG_CLAIM_RATIO, 1.3, 0, "turns at 1.4;"},
                {RG_CLAIM_RATIO, 1.8, 0, "turns at 1.6;"},
                {RG_CLAIM_TIMES, 0.5, 1.7, "turns at 1.6;"},
                {RG_CLAIM_TIMES, 0.5, 1.3, "turns at 1.4;"}};
    struct rg_result result;
    make_uneven(&result);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_claim claim = claim_of(rows[i].test);
        claim.least = rows[i].least;
        claim.most = rows[i].most;
        claim.is_ours = true;
        const struct rg_judgement j = rg_claim_judge(&claim, &result, 0);
        assert_non_null(strstr(j.why, " (1.4 to 1.6), needed: "));
        if (!strstr(j.why, rows[i].turns))
            fail_msg("'%s' is not in: %s", rows[i].turns, j.why);
    }
    rg_result_free(&result);
    double ms[2][ROWS] = {{10, 40, 90, 160, 250}, {1, 1, 1, 1, 1}};
    struct rg_claim power = claim_of(RG_CLAIM_EXPONENT);
    power.least = -2.1;
    power.is_ours = true;
    make(&result, ms, 24);
    expect(
        &power, &result, RG_CLAIM_REPRODUCED,
        "the power is -2 (-2 to -2), needed: -2.1 to 0; the bound is ours, and the verdict turns "
        "at -2; 24 launches");
    rg_result_free(&result);
}

static void open_verdicts_say_what_is_left(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    ratio.least = 1.3;
    make(&result, steady, 3);
    for (int row = 1; row <= ROWS; row++)
        for (int i = 0; i < 3; i++)
            record_at(&result, row)->launches[i].seconds = 0;
    expect(&ratio, &result, RG_CLAIM_UNDECIDED,
           "size 1 is 1.5 times as fast as size 5, needed: at least 1.3; 3 launches; some 21 more "
           "would probably decide");
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).more, 9);
    rg_result_free(&result);
    // 10 s for the two cells of a launch, whether it counts or not.
    make(&result, steady, 8);
    for (int i = 0; i < 8; i++)
        record_at(&result, 1)->launches[i].others = 0.5;
    expect(&ratio, &result, RG_CLAIM_UNDECIDED,
           "all launches were disturbed; 0 launches, and 8 that others disturbed; some 12 more "
           "would probably decide, in 2 min");
    for (int i = 0; i < 6; i++)
        record_at(&result, 1)->launches[i].others = 0;
    const struct rg_judgement j = rg_claim_judge(&ratio, &result, 0);
    assert_equals(j.launch_s, 10);
    assert_non_null(strstr(j.why, "; 6 launches, and 2 that others disturbed; some 18 more would "
                                  "probably decide, in 3 min"));
    rg_result_free(&result);
    make(&result, steady, 24);
    for (int i = 12; i < 24; i++)
        record_at(&result, ROWS)->launches[i].ms = 11;
    const struct rg_judgement unlike = rg_claim_judge(&ratio, &result, 0);
    assert_int_equal(unlike.verdict, RG_CLAIM_UNDECIDED);
    assert_int_equal(unlike.more, 0);
    assert_non_null(
        strstr(unlike.why, "; 24 launches, whose second half does not confirm the first"));
    rg_result_free(&result);
}

static void one_launch_decides_nothing(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    ratio.least = 1.3;
    make(&result, steady, 0);
    expect(&ratio, &result, RG_CLAIM_ONE_LAUNCH,
           "size 1 is 1.5 times as fast as size 5, needed: at least 1.3; one launch, which decides "
           "nothing");
    rg_result_free(&result);
}

// --- errors of images ---

static void a_knee_is_told_by_its_errors(void **state)
{
    (void)state;
    static const struct {
        double first, knee, last;
        enum rg_claim_verdict verdict;
        const char *why;
    } rows[] = {
        {0.5, 0.11, 0.09, RG_CLAIM_REPRODUCED,
         "the error falls from 0.500 to 0.110, and then to 0.090: 19.5 times as far, needed: 3"},
        {0.5, 0.3, 0.1, RG_CLAIM_NOT_REPRODUCED,
         "the error falls from 0.500 to 0.300, and then to 0.100: 1 times as far, needed: 3"},
        // It falls no more behind the knee, or rises; or it does not fall before it.
        {0.5, 0.125, 0.125, RG_CLAIM_REPRODUCED,
         "the error falls from 0.500 to 0.125, and then to 0.125"},
        {0.5, 0.125, 0.25, RG_CLAIM_REPRODUCED,
         "the error falls from 0.500 to 0.125, and then to 0.250"},
        {0.125, 0.25, 0.0625, RG_CLAIM_NOT_REPRODUCED,
         "the error falls from 0.125 to 0.250, and then to 0.062"},
        {0.25, 0.25, 0.125, RG_CLAIM_NOT_REPRODUCED,
         "the error falls from 0.250 to 0.250, and then to 0.125"},
        {0.25, 0.25, 0.25, RG_CLAIM_NOT_REPRODUCED,
         "the error falls from 0.250 to 0.250, and then to 0.250"}};
    struct rg_result result;
    struct rg_claim knee = claim_of(RG_CLAIM_FLATTENS);
    knee.knee = 3;
    knee.least = 3;
    make(&result, steady, 0);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        record_at(&result, 1)->truth_error.flip_mask_mean = rows[i].first;
        record_at(&result, 3)->truth_error.flip_mask_mean = rows[i].knee;
        record_at(&result, 5)->truth_error.flip_mask_mean = rows[i].last;
        expect(&knee, &result, rows[i].verdict, rows[i].why);
        assert_int_equal(rg_claim_judge(&knee, &result, 0).figures,
                         rows[i].verdict == RG_CLAIM_REPRODUCED ? RG_FIGURES_FIT : RG_FIGURES_MISS);
    }
    record_at(&result, 5)->truth_error =
        (struct rg_truth_error){.outcome = RG_ERROR, .detail = "no picture"};
    expect(&knee, &result, RG_CLAIM_NOT_SEEN, "row 5 has no error: no picture");
    *result.truth = 0;
    expect(&knee, &result, RG_CLAIM_NOT_SEEN, "row 1 has no error: ");
    rg_result_free(&result);
}

// --- claims that are not judged ---

static void what_is_missing_is_named(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_claim falls = claim_of(RG_CLAIM_FALLS);
    make(&result, steady, 0);
    rg_record_end(record_at(&result, 4), RG_CRASH, "the driver ended");
    expect(&falls, &result, RG_CLAIM_NOT_SEEN, "row 4 has no number: the driver ended");
    record_at(&result, 3)->sample_count = 0;
    expect(&falls, &result, RG_CLAIM_NOT_SEEN, "row 3 is not measured");
    rg_result_drop_row(&result, 1);
    expect(&falls, &result, RG_CLAIM_NOT_SEEN, "row 2 is not measured");
    falls.last = 1; // its other variant must have a number, too
    falls.other = "other";
    rg_record_end(rg_result_at(&result, (struct rg_place){.variant = 1}), RG_ERROR, "is tired");
    expect(&falls, &result, RG_CLAIM_NOT_SEEN, "row 1 has no number: is tired");
    falls.other = "bare";
    expect(&falls, &result, RG_CLAIM_NOT_SEEN, "variant bare is not measured");
    falls.variant = "none";
    expect(&falls, &result, RG_CLAIM_NOT_SEEN, "variant none is not measured");
    rg_result_free(&result);
}

// A part of a table has neither the rows before its first nor those behind its last.
static void rows_beside_a_part_are_missing(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    make(&result, steady, 0);
    assert_true(rg_result_keep_rows(&result, 1, 3));
    ratio.least = 1.01;
    ratio.last = 4;
    expect(&ratio, &result, RG_CLAIM_NOT_SEEN, "row 1 is not measured");
    ratio.first = 2;
    assert_int_equal(rg_claim_judge(&ratio, &result, 0).figures, RG_FIGURES_FIT);
    ratio.last = 5;
    expect(&ratio, &result, RG_CLAIM_NOT_SEEN, "row 5 is not measured");
    rg_result_free(&result);
}

static void draw_particles(struct rg_record *r, double drawn)
{
    r->published_count = 2;
    r->fact_count = 1;
    rg_named_set_number(&r->published[1], "particles", 1000);
    rg_named_set_number(&r->facts[0], "particles", drawn);
}

// Rows at the ends of a claim and its knee must do the printed work; others may be left out.
static void rows_of_other_work_are_named(void **state)
{
    (void)state;
    static const struct {
        int row, knee;
        const char *why;
    } rows[] = {{1, 0, "row 1 draws 1.50 times as many or as few particles"},
                {5, 0, "row 5 draws 1.50 times as many or as few particles"},
                {3, 3, "row 3 draws 1.50 times as many or as few particles"},
                {3, 2, NULL}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_result result;
        struct rg_claim slowest = claim_of(RG_CLAIM_SLOWEST);
        slowest.knee = rows[i].knee ? rows[i].knee : 2;
        make(&result, steady, 0);
        draw_particles(record_at(&result, rows[i].row), 1500);
        const struct rg_judgement j = rg_claim_judge(&slowest, &result, 0);
        if (rows[i].why)
            assert_string_equal(j.why, rows[i].why);
        assert_int_equal(j.verdict, rows[i].why ? RG_CLAIM_OTHER_WORK : RG_CLAIM_ONE_LAUNCH);
        rg_result_free(&result);
    }
}

static void other_work_is_told(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_claim rate = claim_of(RG_CLAIM_RATE);
    make(&result, steady, 0);
    result.size_divisor = 4;
    expect(&rate, &result, RG_CLAIM_OTHER_WORK,
           "pictures have 1/4 of the width and height that the rate is claimed of");
    result.size_divisor = 1;
    snprintf(result.quick, sizeof(result.quick), "city=small");
    expect(&rate, &result, RG_CLAIM_OTHER_WORK,
           "quick settings are less work than the rate is claimed of: city=small");
    snprintf(result.changed, sizeof(result.changed), "seed=2");
    expect(&rate, &result, RG_CLAIM_OTHER_WORK, "settings were changed: seed=2");
    *result.changed = *result.quick = 0;
    result.work_count = 1;
    snprintf(result.works[0].saves, RG_TITLE_SIZE, "half of it");
    expect(&rate, &result, RG_CLAIM_OTHER_WORK, "the work that was printed is not measured");
    rg_result_free(&result);
}

// Print contradicts a claim only where it has all that the claim compares, whatever was measured.
static void print_contradicts_by_itself(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO), faster = claim_of(RG_CLAIM_FASTER);
    ratio.least = 6; // print: 5
    faster.other = "other";
    faster.least = 1; // in print the last rows are slower
    make(&result, steady, 0);
    assert_true(rg_claim_judge(&ratio, &result, 0).print_contradicts);
    assert_true(rg_claim_judge(&faster, &result, 0).print_contradicts);
    faster.last = 1;
    assert_false(rg_claim_judge(&faster, &result, 0).print_contradicts);
    result.work_count = 1; // not the printed one
    assert_true(rg_claim_judge(&ratio, &result, 0).print_contradicts);
    result.work_count = 0;
    faster.last = ROWS;
    rg_result_at(&result, (struct rg_place){.row = ROWS - 1, .variant = 1})->published_count = 0;
    assert_true(rg_claim_judge(&ratio, &result, 0).print_contradicts);
    assert_false(rg_claim_judge(&faster, &result, 0).print_contradicts);
    record_at(&result, ROWS)->published_count = 0;
    assert_false(rg_claim_judge(&ratio, &result, 0).print_contradicts);
    faster.other = "bare";
    assert_false(rg_claim_judge(&faster, &result, 0).print_contradicts);
    struct rg_claim knee = claim_of(RG_CLAIM_FLATTENS);
    knee.knee = 3;
    assert_false(rg_claim_judge(&knee, &result, 0).print_contradicts);
    rg_result_free(&result);
}

static void rows_alike_in_print_do_not_cross(void **state)
{
    (void)state;
    struct rg_result result;
    struct rg_claim crosses = claim_of(RG_CLAIM_CROSSES);
    crosses.other = "other";
    crosses.first = crosses.last = crosses.knee = 3;
    make(&result, steady, 24);
    expect(&crosses, &result, RG_CLAIM_NOT_SEEN, "no two rows are there to compare");
    rg_result_free(&result);
}

// --- the rows and variants of a claim ---

static void claims_need_their_rows_and_variants(void **state)
{
    (void)state;
    static const struct {
        enum rg_claim_test test;
        const char *needed; // of five rows
    } rows[] = {
        {RG_CLAIM_FALLS, ".xxxx"},   {RG_CLAIM_RATIO, ".x..x"},    {RG_CLAIM_TIMES, ".x..x"},
        {RG_CLAIM_ALIKE, ".xxxx"},   {RG_CLAIM_EXPONENT, ".xxxx"}, {RG_CLAIM_FASTER, ".xxxx"},
        {RG_CLAIM_OPTIMUM, ".xxxx"}, {RG_CLAIM_CROSSES, ".xxxx"},  {RG_CLAIM_FLATTENS, ".x.xx"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_claim claim = claim_of(rows[i].test);
        claim.first = 2;
        claim.knee = 4;
        for (int row = 1; row <= ROWS; row++)
            assert_int_equal(rg_claim_needs(&claim, row, "full"), rows[i].needed[row - 1] == 'x');
        assert_false(rg_claim_needs(&claim, 2, "other"));
        claim.other = "other";
        assert_true(rg_claim_needs(&claim, 2, "other") && rg_claim_needs(&claim, 2, "full"));
        assert_false(rg_claim_needs(&claim, 2, "bare") || rg_claim_needs(&claim, 1, "other"));
    }
    // The faster row of a ratio may stand below the slower one.
    struct rg_claim ratio = claim_of(RG_CLAIM_RATIO);
    ratio.first = 4;
    ratio.last = 2;
    for (int row = 1; row <= ROWS; row++)
        assert_int_equal(rg_claim_needs(&ratio, row, "full"), row == 2 || row == 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_test_says_what_it_compared),
        cmocka_unit_test(a_power_is_of_the_first_number),
        cmocka_unit_test(the_verdict_turns_at_an_end_of_the_interval),
        cmocka_unit_test(open_verdicts_say_what_is_left),
        cmocka_unit_test(one_launch_decides_nothing),
        cmocka_unit_test(a_knee_is_told_by_its_errors),
        cmocka_unit_test(what_is_missing_is_named),
        cmocka_unit_test(rows_beside_a_part_are_missing),
        cmocka_unit_test(rows_of_other_work_are_named),
        cmocka_unit_test(other_work_is_told),
        cmocka_unit_test(print_contradicts_by_itself),
        cmocka_unit_test(rows_alike_in_print_do_not_cross),
        cmocka_unit_test(claims_need_their_rows_and_variants),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
