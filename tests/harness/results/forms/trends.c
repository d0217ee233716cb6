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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
