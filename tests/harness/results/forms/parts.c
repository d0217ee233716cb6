// Parts of a table: variants, works and rows that are kept or left out.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/tables/sheet/trend.h"
#include "tests/harness/results/forms/rig.h"

// In each work the cells of one variant stay, and the others go.
static void test_keeping_a_variant(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_styles_table, (double[]){11, 12, 13, 14, 21, 22, 23, 24});
    assert_false(rg_result_keep_variant(&rig.result, "nonsense"));
    assert_true(rg_result_keep_variant(&rig.result, "no_geometry"));
    assert_int_equal(rig.result.variant_count, 1);
    assert_string_equal(rig.result.variants[0], "no_geometry");
    const double fps[] = {12, 14, 22, 24};
    int cells = 0;
    for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);) {
        const struct rg_record *record = rg_result_at(&rig.result, at);
        assert_string_equal(record->variant, "no_geometry");
        assert_float_equal(rg_record_fps(record), fps[cells++], 1e-9);
    }
    assert_int_equal(cells, 4);
    rg_result_free(&rig.result);
}

// A part of a table has its own variant's settings and print.
static void test_part_of_one_variant(void **state)
{
    (void)state;
    const struct rg_devices devices = {.count = 1, .devices = {&sheet_device}};
    const struct rg_table_part part = {
        .last_row = 0, .variant = "no_geometry", .work = "paper", .set = "seed=2"};
    struct rg_result result = {0};
    rg_table_begin(&result, &sheet_styles_table, &part, &devices);
    assert_true(rg_table_add_row(&result, &sheet_styles_table, 0));
    const struct rg_record *record = rg_result_at(&result, (struct rg_place){0});
    assert_int_equal(rg_result_row_cells(&result), 1);
    assert_string_equal(record->variant, "no_geometry");
    assert_string_equal(record->set, "geometry=off blocks=all seed=2");
    assert_float_equal(rg_record_published_fps(record), 200, 0);
    assert_string_equal(result.changed, "seed=2");
    rg_result_free(&result);
}

static const struct rg_table works_table = {
    .id = "works",
    .technique = "flow",
    .hardware = "paper",
    .columns = {"radius_m", "fps"},
    .key_count = 1,
    .variants = {{"full", "panes=mirror", "fps"}},
    .works = {{"paper", "blocks=all", ""}, {"ours", "", "less is drawn"}},
    .row_count = 3,
    .rows = (const struct rg_table_row[]){{"a=1", {5, 400}, NULL},
                                          {"a=2", {10, 200}, NULL},
                                          {"a=3", {20, 100}, NULL}},
    .note = "a note",
};

// Work that saves something stands next to the printed work, and is not compared with print.
static void test_works(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &works_table, (double[]){40, 80, 20, 60, 10, 50});
    rg_result_sheet(&rig.result, &sheet);
    assert_int_equal(sheet.row_count, 6);
    sheet_expect_text(&sheet, 0, "work", "paper");
    sheet_expect_text(&sheet, 0, "fps / published", "0.10");
    sheet_expect_text(&sheet, 1, "work", "ours");
    sheet_expect_text(&sheet, 1, "fps", "80.0");
    sheet_expect_text(&sheet, 1, "fps / published", "");
    assert_false(sheet_has_note(&sheet, "Spread of fps")); // its rows have no names
    assert_true(sheet_has_note(&sheet, "Shape on cpu, paper: reproduced."));
    assert_false(sheet_has_note(&sheet, "Shape on cpu, ours"));
    assert_true(sheet_has_note(&sheet, "less is drawn"));
    rg_sheet_free(&sheet);
    struct rg_place ours = {.work = 1};
    assert_string_equal(rg_result_at(&rig.result, ours)->set, "a=1 panes=mirror");
    assert_int_equal(rg_trend_of(&rig.result, ours).verdict, RG_TREND_OTHER_WORK);
    assert_string_equal(sheet_record_at(&rig, 1, 0)->set, "a=2 panes=mirror blocks=all");
    // One work alone, kept after measuring.
    assert_false(rg_result_keep_work(&rig.result, "theirs"));
    assert_true(rg_result_keep_work(&rig.result, "ours"));
    assert_int_equal(rg_result_row_cells(&rig.result), 1);
    assert_float_equal(rg_record_fps(sheet_record_at(&rig, 2, 0)), 50, 1e-9);
    assert_string_equal(sheet_record_at(&rig, 2, 0)->work, "ours");
    rg_result_free(&rig.result);
    // One work alone, chosen before measuring.
    const struct rg_table_part part = {.last_row = 2, .work = "paper"};
    rg_table_begin(&rig.result, &works_table, &part, &rig.devices);
    assert_int_equal(rig.result.work_count, 1);
    assert_string_equal(rig.result.works[0].name, "paper");
    rg_result_free(&rig.result);
}

// Rows and works are left out of a table without works.
static void test_keeping(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 80, 20, 40, 10, 10});
    assert_true(rg_result_keep_work(&rig.result, "paper")); // the table tells no works apart
    assert_int_equal(rg_result_row_cells(&rig.result), 2);
    assert_true(rg_result_keep_rows(&rig.result, 1, 5));
    assert_int_equal(rig.result.first_row, 1);
    assert_int_equal(rig.result.last_row, 2);
    assert_float_equal(rg_record_fps(sheet_record_at(&rig, 1, 1)), 40, 1e-9);
    assert_float_equal(rg_record_fps(sheet_record_at(&rig, 2, 0)), 10, 1e-9);
    int cells = 0;
    for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);)
        cells++;
    assert_int_equal(cells, 4);
    assert_false(rg_result_keep_rows(&rig.result, 5, 7));
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_keeping_a_variant),
        cmocka_unit_test(test_part_of_one_variant),
        cmocka_unit_test(test_works),
        cmocka_unit_test(test_keeping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
