// The notes of a sheet about its whole table: costs, spread, growth.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/record/schema/schema.h"
#include "harness/tables/sheet/trend.h"
#include "tests/harness/results/forms/rig.h"
#include "tests/tools/expect.h"

// Named rows of no paper; the first row has all parts on.
static const struct rg_table parts_table = {
    .id = "parts",
    .technique = "drops",
    .names = "parts",
    .columns = {"merge"},
    .key_count = 1,
    .has_choices = true,
    .truth = "merge=on",
    .variants = {{"full", "", NULL}},
    .row_count = 3,
    .rows = (const struct rg_table_row[]){{"", {1}, "all"},
                                          {"merge=off", {0}, "no merging"},
                                          {"merge=off erode=off", {0}, "none"}},
    .note = "a note",
};

// A part's cost is a frame's time without it, as a share of the whole frame's.
static void test_costs(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &parts_table, (double[]){50, 100, 40});
    sheet_record_at(&rig, 1, 0)->truth_error.flip_mask_mean = 0.25;
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet,
                               "Cost on cpu: of the time of a frame of `all`, one of these takes: "
                               "no merging 0.50 (FLIP 0.250), none 1.25 (FLIP 0.000)."));
    rg_sheet_free(&sheet);
    sheet_record_at(&rig, 2, 0)->outcome = RG_FAIL;
    rg_result_sheet(&rig.result, &sheet);
    assert_false(sheet_has_note(&sheet, "Cost on cpu"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

static const struct rg_table growth_table = {
    .id = "growth",
    .technique = "flow",
    .columns = {"drops"},
    .key_count = 1,
    .variants = {{"full", "", NULL}},
    .row_count = 4,
    .rows =
        (const struct rg_table_row[]){
            {"", {10}, NULL}, {"", {100}, NULL}, {"", {1000}, NULL}, {"", {10000}, NULL}},
    .note = "a note",
};

// The exponent of a frame's time, as another program calculated it, with its interval.
static void test_growth(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    const double fps[] = {1000 / 1., 1000 / 2.2, 1000 / 3.9, 1000 / 8.1};
    sheet_measure(&rig, &growth_table, fps);
    const struct rg_trend s = rg_trend_of(&rig.result, (struct rg_place){.row = 0});
    assert_int_equal(s.verdict, RG_TREND_GROWTH);
    assert_true(s.has_slope);
    assert_float_equal(s.slope, -0.29740970, 1e-7);
    assert_float_equal(s.slope_low, s.slope, 2e-4);
    assert_float_equal(s.slope_high, s.slope, 2e-4);
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet,
                               "Growth on cpu: the time of a frame goes with drops to the power "
                               "0.30 (95 %: 0.30 to 0.30)."));
    assert_false(sheet_has_note(&sheet, "Shape on cpu"));
    rg_sheet_free(&sheet);
    json_t *trends = rg_trends_json(&rig.result);
    const char *verdict;
    double low, high;
    assert_int_equal(0, json_unpack(trends, "[{ss, sF, sF, sn}]", "verdict", &verdict, "slope_low",
                                    &low, "slope_high", &high, "published_slope"));
    assert_string_equal(verdict, "growth");
    assert_below(low, s.slope);
    assert_below(s.slope, high);
    json_decref(trends);
    rg_result_free(&rig.result);
}

// Two rows give a slope, with an interval from their samples. A row without a time gives no slope
// at all.
static void test_growth_of_few_rows(void **state)
{
    (void)state;
    struct rg_table two = growth_table;
    struct rig rig;
    struct rg_sheet sheet;
    two.row_count = 2;
    sheet_measure(&rig, &two, (double[]){1000, 100});
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet, "goes with drops to the power 1.00 (95 %: 1.00 to 1.00)."));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
    assert_int_equal(sheet_trend_of(&growth_table, 0, (double[]){9, 0, 3, 1}).verdict,
                     RG_TREND_UNKNOWN);
}

// The spread over rows and variants, and the largest over the rows of one variant. Work that saves
// something is not compared with print.
static void test_spread(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_styles_table, (double[]){50, 100, 60, 110, 45, 50, 60, 110});
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet,
                               "Spread of fps on cpu, paper: 45.0 to 100.0, by 55 %, over the "
                               "rows of a variant by up to 50 %; published 80.00 to 200.00, by "
                               "60 %, over the rows of a variant by up to 20 %."));
    assert_true(sheet_has_note(&sheet,
                               "Spread of fps on cpu, ours: 60.0 to 110.0, by 45 %, over the rows "
                               "of a variant by up to 0 %."));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
    sheet_measure(&rig, &sheet_styles_table, (double[]){50, 100, 60, 110, 0, 50, 60, 110});
    rg_result_sheet(&rig.result, &sheet);
    assert_false(sheet_has_note(&sheet, "Spread of fps on cpu, paper"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// Names and rates too long for their space are cut, without writing beyond it: a record from
// elsewhere may have such.
static void test_long_names_and_rates(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_styles_table, (double[]){1e303, 1e302, 60, 110, 1e301, 50, 60, 110});
    for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);) {
        struct rg_record *record = rg_result_at(&rig.result, at);
        record->row_count = RG_MAX_VALUES;
        for (int i = 0; i < RG_MAX_VALUES; i++) {
            memset(&record->row[i], 0, sizeof(record->row[i]));
            memset(record->row[i].name, 'k', sizeof(record->row[i].name) - 1);
            memset(record->row[i].text, 't', sizeof(record->row[i].text) - 1);
        }
    }
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet, "Spread of fps on cpu, paper: 50.0 to 1000000"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// In Markdown the lead notes stand above the table, and all others below it.
static void test_lead_notes(void **state)
{
    (void)state;
    struct rg_sheet sheet = {.title = "claims", .lead_count = 2};
    rg_sheet_column(&sheet, "paper");
    snprintf(rg_sheet_row(&sheet)[0], RG_SHEET_CELL, "%s", "cell");
    for (int n = 0; n < 5; n++)
        rg_sheet_note(&sheet, "note %d", n);
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    rg_sheet_print_md(&sheet, out);
    assert_int_equal(fclose(out), 0);
    const char *cell = strstr(text, "cell");
    assert_non_null(cell);
    for (int n = 0; n < 5; n++) {
        char wanted[16];
        snprintf(wanted, sizeof(wanted), "note %d", n);
        const char *found = strstr(text, wanted);
        assert_non_null(found);
        assert_equals(found < cell, n < 2);
    }
    free(text);
    rg_sheet_free(&sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_costs),
        cmocka_unit_test(test_spread),
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_growth_of_few_rows),
        cmocka_unit_test(test_long_names_and_rates),
        cmocka_unit_test(test_lead_notes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
