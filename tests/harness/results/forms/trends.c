// Whether measured numbers keep the order and the slope of print.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>

#include "harness/record/schema/schema.h"
#include "harness/tables/sheet/trend.h"
#include "tests/harness/results/forms/rig.h"
#include "tests/tools/expect.h"

static void test_order_of_names(void **state)
{
    (void)state;
    // Dragon and Buddha are equal in print, so they may have any order.
    struct rg_trend s = sheet_trend_of(&sheet_names_table, 0, (double[]){50, 10, 11, 20});
    assert_int_equal(s.verdict, RG_TREND_ORDER);
    assert_int_equal(s.pairs, 5);
    assert_int_equal(s.pairs_in_order, 5);
    assert_false(s.has_slope);
    assert_int_equal(sheet_trend_of(&sheet_names_table, 0, (double[]){50, 11, 10, 20}).verdict,
                     RG_TREND_ORDER);
    s = sheet_trend_of(&sheet_names_table, 0,
                       (double[]){50, 30, 10, 20}); // the dragon before Planck
    assert_int_equal(s.verdict, RG_TREND_NOT);
    assert_int_equal(s.pairs_in_order, 4);
    s = sheet_trend_of(&sheet_names_table, 0, (double[]){50, 0, 10, 20});
    assert_int_equal(s.verdict, RG_TREND_UNKNOWN);
}

// Two cameras, each with three rows: no row is compared with one of the other camera.
static void test_groups(void **state)
{
    (void)state;
    static const struct rg_table_row rows[] = {
        {"", {5, 1, 1, 400, 1}, NULL},  {"", {10, 1, 1, 200, 1}, NULL},
        {"", {20, 1, 1, 100, 1}, NULL}, {"", {5, 2, 1, 40, 1}, NULL},
        {"", {10, 2, 1, 20, 1}, NULL},  {"", {20, 2, 1, 10, 1}, NULL}};
    struct rg_table table = sheet_axis_table;
    table.rows = rows;
    table.row_count = 6;
    // The second camera is faster here.
    struct rg_trend s =
        sheet_trend_of(&table, 0, (double[]){40, 1, 20, 1, 10, 1, 400, 1, 200, 1, 100, 1});
    assert_int_equal(s.verdict, RG_TREND_REPRODUCED);
    assert_int_equal(s.pairs, 6);
    assert_float_equal(s.slope, -1, 1e-6);
    assert_float_equal(s.published_slope, -1, 1e-9);
    // If each row has another value of the second key, that key follows the axis and makes no
    // groups.
    struct rg_table_row single[] = {rows[0], rows[1], rows[2]};
    for (int i = 0; i < 3; i++)
        single[i].values[1] = i;
    table.rows = single;
    table.row_count = 3;
    s = sheet_trend_of(&table, 0, (double[]){40, 1, 20, 1, 10, 1});
    assert_int_equal(s.pairs, 3);
    assert_float_equal(s.slope, -1, 1e-6);
}

// One of three pairs is in another order than in print: the samples must settle it, or the verdict
// is open.
static void test_unsettled_order(void **state)
{
    (void)state;
    struct rg_trend s = sheet_trend_of(&sheet_axis_table, 0, (double[]){40, 1, 20, 1, 19.999, 1});
    assert_int_equal(s.verdict, RG_TREND_UNDECIDED);
    assert_int_equal(s.pairs_in_order, 3);
    assert_int_equal(s.pairs_undecided, 1);
    s = sheet_trend_of(&sheet_axis_table, 0, (double[]){40, 1, 20, 1, 20.001, 1});
    assert_int_equal(s.verdict, RG_TREND_UNDECIDED);
    assert_int_equal(s.pairs_in_order, 2);
    assert_int_equal(
        sheet_trend_of(&sheet_axis_table, 0, (double[]){40, 1, 20, 1, 20.1, 1}).verdict,
        RG_TREND_NOT);
}

static void test_slope_along_axis(void **state)
{
    (void)state;
    // Variant by variant: full, no_geometry.
    struct rg_trend s = sheet_trend_of(&sheet_axis_table, 0, (double[]){40, 1, 20, 1, 10, 1});
    assert_int_equal(s.verdict, RG_TREND_REPRODUCED);
    assert_true(s.has_slope);
    assert_float_equal(s.slope, -1, 1e-9);
    assert_float_equal(s.published_slope, -1, 1e-9);
    s = sheet_trend_of(&sheet_axis_table, 0, (double[]){40, 1, 39, 1, 38, 1});
    assert_int_equal(s.verdict, RG_TREND_ONLY);
    s = sheet_trend_of(&sheet_axis_table, 0, (double[]){90, 1, 30, 1, 10, 1}); // too fast
    assert_int_equal(s.verdict, RG_TREND_ONLY);
    assert_int_equal(sheet_trend_of(&sheet_axis_table, 0, (double[]){40, 1, 41, 1, 38, 1}).verdict,
                     RG_TREND_NOT);
    // The other variant is compared with its own column, in which two rows are equal.
    s = sheet_trend_of(&sheet_axis_table, 1, (double[]){1, 80, 1, 39, 1, 41});
    assert_int_equal(s.verdict, RG_TREND_REPRODUCED);
    assert_int_equal(s.pairs, 2);
}

// A row that draws more than 1.2 times the printed particles takes no part. With changed settings
// no row does.
static void test_other_work(void **state)
{
    (void)state;
    struct rig rig;
    const struct rg_place full = {0};
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 1, 200, 1, 10, 1});
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_NOT);
    sheet_tell(sheet_record_at(&rig, 1, 0), "particles", 198818 * 1.19);
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_NOT);
    sheet_record_at(&rig, 1, 0)->facts[0].number = 198818 * 1.21;
    const struct rg_trend trend = rg_trend_of(&rig.result, full);
    assert_int_equal(trend.verdict, RG_TREND_REPRODUCED);
    assert_int_equal(trend.pairs, 1);
    snprintf(rig.result.changed, sizeof(rig.result.changed), "seed=2");
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_OTHER_WORK);
    rg_result_free(&rig.result);
}

// Fewer than six samples decide nothing, and print no interval.
static void test_few_samples(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    for (int samples = 5; samples <= 6; samples++) {
        sheet_measure_few(&rig, &sheet_axis_table, (double[]){40, 1, 20, 1, 10, 1}, samples);
        const struct rg_trend s = rg_trend_of(&rig.result, (struct rg_place){0});
        assert_int_equal(s.verdict, samples < 6 ? RG_TREND_UNDECIDED : RG_TREND_REPRODUCED);
        assert_int_equal(s.pairs_undecided, samples < 6 ? 3 : 0);
        assert_equals(!isfinite(s.slope_low), (samples < 6));
        rg_result_sheet(&rig.result, &sheet);
        const char *interval = sheet_text_at(&sheet, 0, "ms, 95 %");
        assert_non_null(interval);
        assert_equals(!*interval, (samples < 6));
        rg_sheet_free(&sheet);
        json_t *json = rg_result_json(&rig.result);
        assert_non_null(json);
        const json_t *measured =
            json_object_get(json_array_get(json_object_get(json, "cells"), 0), "measured");
        assert_equals(json_is_null(json_object_get(measured, "ms_low")), (samples < 6));
        assert_equals(json_is_null(json_object_get(measured, "ms_high")), (samples < 6));
        json_decref(json);
        rg_result_free(&rig.result);
    }
}

// A row measured while the machine was a tenth slower may be slower because of that.
static void test_drift(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    const struct rg_place full = {0};
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 1, 20, 1, 19, 1});
    for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);) {
        struct rg_record *record = rg_result_at(&rig.result, at);
        record->calibration_begin_ms = at.row == 2 ? 2.1 : 2;
        record->calibration_end_ms = at.row == 2 ? 2.3 : 2;
    }
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_UNDECIDED);
    assert_int_equal(rg_trend_of(&rig.result, full).pairs_undecided, 1);
    assert_float_equal(rg_result_drift(&rig.result), 0.15, 1e-9);
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet, "drifted by 15.0 % over the run"));
    rg_sheet_free(&sheet);
    sheet_record_at(&rig, 2, 0)->calibration_begin_ms =
        sheet_record_at(&rig, 2, 0)->calibration_end_ms = 2;
    assert_int_equal(rg_trend_of(&rig.result, full).pairs_undecided, 0);
    rg_result_free(&rig.result);
}

// A budget may leave out the first of the chosen rows.
static void test_first_row_left_out(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 1, 20, 1, 10, 1});
    free(rig.result.rows[0]);
    rig.result.rows[0] = NULL;
    rig.result.left_out[0] = true;
    assert_string_equal(rg_trend_of(&rig.result, (struct rg_place){0}).axis->name, "radius_m");
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet, "it goes with radius_m to the power"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// A trend needs all rows, the last one too.
static void test_a_row_that_is_missing(void **state)
{
    (void)state;
    for (int row = 0; row < 3; row++) {
        struct rig rig;
        sheet_measure(&rig, &sheet_axis_table, (double[]){40, 1, 20, 1, 10, 1});
        assert_int_equal(rg_trend_of(&rig.result, (struct rg_place){0}).verdict,
                         RG_TREND_REPRODUCED);
        rg_result_drop_row(&rig.result, row);
        const struct rg_trend trend = rg_trend_of(&rig.result, (struct rg_place){0});
        assert_int_equal(trend.verdict, RG_TREND_UNKNOWN);
        assert_true(!trend.axis && !trend.pairs && !trend.has_slope);
        rg_result_free(&rig.result);
    }
}

// Each verdict has its words.
static void test_words(void **state)
{
    (void)state;
    static const char *const due[] = {
        [RG_TREND_REPRODUCED] = "reproduced",  [RG_TREND_ONLY] = "trend only",
        [RG_TREND_ORDER] = "same order",       [RG_TREND_NOT] = "not reproduced",
        [RG_TREND_UNDECIDED] = "undecided",    [RG_TREND_GROWTH] = "growth",
        [RG_TREND_UNKNOWN] = "not comparable", [RG_TREND_OTHER_WORK] = "other work"};
    for (int i = 0; i <= RG_TREND_OTHER_WORK; i++)
        assert_string_equal(rg_trend_text((enum rg_trend_verdict)i), due[i]);
}

static void expect_shape(const json_t *shape, const char *variant, const char *verdict,
                         bool same_ranking, int pairs, int in_order, int undecided)
{
    const char *device, *of, *told;
    int same, numbers[3];
    assert_int_equal(0, json_unpack((json_t *)shape, "{ss, ss, ss, sb, si, si, si}", "device",
                                    &device, "variant", &of, "verdict", &told, "same_ranking",
                                    &same, "pairs", &numbers[0], "pairs_in_order", &numbers[1],
                                    "pairs_undecided", &numbers[2]));
    assert_string_equal(device, "cpu");
    assert_string_equal(of, variant);
    assert_string_equal(told, verdict);
    assert_int_equal(same, same_ranking);
    assert_int_equal(numbers[0], pairs);
    assert_int_equal(numbers[1], in_order);
    assert_int_equal(numbers[2], undecided);
}

// In documents and in notes: a variant whose order is open, and one that has another order.
static void test_shapes(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 10, 20, 39, 19.999, 41});
    json_t *shapes = rg_trends_json(&rig.result);
    assert_int_equal(json_array_size(shapes), 2);
    const json_t *open = json_array_get(shapes, 0);
    expect_shape(open, "full", "undecided", true, 3, 3, 1);
    expect_shape(json_array_get(shapes, 1), "no_geometry", "not reproduced", false, 2, 0, 0);
    double slope, printed;
    assert_int_equal(
        0, json_unpack((json_t *)open, "{sF, sF}", "slope", &slope, "published_slope", &printed));
    assert_below(fabs(slope + 0.5), 1e-3);
    assert_below(fabs(printed + 1), 1e-9);
    assert_null(json_object_get(open, "work"));
    assert_true(json_is_real(json_object_get(open, "slope_low")));
    assert_true(json_is_number(json_object_get(open, "published_margin")));
    json_decref(shapes);
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet,
                               "Shape on cpu, full: undecided. fps keeps the published order (3 of "
                               "3 pairs of rows; the samples do not settle 1); it goes with "
                               "radius_m to the power -0.50 (95 %: -0.50 to -0.50), published "
                               "-1.00 ("));
    assert_true(sheet_has_note(&sheet,
                               "Shape on cpu, no_geometry: not reproduced. fps does not keep the "
                               "published order (0 of 2 pairs of rows)"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// Rows without an axis have no slope, and their works have names.
static void test_shapes_without_an_axis(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_styles_table, (double[]){50, 100, 60, 110, 45, 50, 60, 110});
    json_t *shapes = rg_trends_json(&rig.result);
    assert_int_equal(json_array_size(shapes), 4);
    for (int i = 0; i < 4; i++) {
        const json_t *shape = json_array_get(shapes, (size_t)i);
        assert_string_equal(json_string_value(json_object_get(shape, "work")),
                            i < 2 ? "paper" : "ours");
        assert_null(json_object_get(shape, "slope_low"));
        assert_true(i > 1 || json_is_null(json_object_get(shape, "slope")));
    }
    expect_shape(json_array_get(shapes, 0), "full", "same order", true, 1, 1, 0);
    expect_shape(json_array_get(shapes, 3), "no_geometry", "other work", true, 0, 0, 0);
    json_decref(shapes);
    rg_result_free(&rig.result);
}

// The three numbers behind some words of a note: a power, and its interval's ends.
static void expect_interval(const struct rg_sheet *sheet, const char *words, double power)
{
    double middle, low, high;
    const char *found = NULL;
    for (int n = 0; n < sheet->note_count && !found; n++)
        found = strstr(sheet->notes[n], words);
    assert_non_null(found);
    assert_int_equal(
        sscanf(found + strlen(words), " %lf (95 %%: %lf to %lf)", &middle, &low, &high), 3);
    assert_below(fabs(middle - power), 0.05);
    assert_below(low, middle);
    assert_below(middle, high);
}

// Scattered samples have wide intervals, which are told from the lower end to the upper one.
static void test_intervals(void **state)
{
    (void)state;
    for (int is_printed = 0; is_printed < 2; is_printed++) {
        struct rig rig;
        struct rg_sheet sheet;
        struct rg_table table = sheet_axis_table;
        table.hardware = is_printed ? "paper" : NULL;
        sheet_measure(&rig, &table, (double[]){40, 40, 20, 20, 10, 10});
        for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);) {
            struct rg_record *record = rg_result_at(&rig.result, at);
            for (int i = 0; i < record->sample_count; i++)
                record->samples_ms[i] *= 1 + 0.03 * ((i * 4 + at.row) % 11 - 5);
            rg_record_settle(record);
        }
        rg_result_sheet(&rig.result, &sheet);
        expect_interval(&sheet, "goes with radius_m to the power", is_printed ? -1 : 1);
        rg_sheet_free(&sheet);
        rg_result_free(&rig.result);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_first_row_left_out),
        cmocka_unit_test(test_order_of_names),
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_unsettled_order),
        cmocka_unit_test(test_slope_along_axis),
        cmocka_unit_test(test_other_work),
        cmocka_unit_test(test_few_samples),
        cmocka_unit_test(test_drift),
        cmocka_unit_test(test_intervals),
        cmocka_unit_test(test_a_row_that_is_missing),
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_shapes_without_an_axis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
