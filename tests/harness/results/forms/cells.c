// Sheets for people: cells, and what every row tells.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "harness/record/schema/schema.h"
#include "tests/harness/results/forms/rig.h"
#include "tests/tools/expect.h"

static void test_sheet(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 80, 20, 40, 0, 10});
    sheet_tell(sheet_record_at(&rig, 0, 0), "particles", 70000);
    rg_named_set_text(&sheet_record_at(&rig, 0, 0)->facts[1], "model", "city.obj");
    sheet_record_at(&rig, 0, 0)->fact_count = 2;
    rg_result_sheet(&rig.result, &sheet);
    assert_int_equal(sheet.row_count, 6);
    assert_string_equal(sheet.columns[0], "radius_m");
    assert_string_equal(sheet.columns[1], "camera");
    sheet_expect_text(&sheet, 1, "radius_m", "5");
    sheet_expect_text(&sheet, 1, "published particles", "70303");
    sheet_expect_text(&sheet, 0, "particles", "70000");
    sheet_expect_text(&sheet, 0, "published fps", "400");
    sheet_expect_text(&sheet, 1, "published fps", "800");
    sheet_expect_text(&sheet, 1, "variant", "no_geometry");
    sheet_expect_text(&sheet, 1, "fps / published", "0.10");
    sheet_expect_text(&sheet, 4, "fps", "fail");
    assert_true(sheet_has_note(&sheet, "radius_m 20, camera 1, full on cpu: differs"));
    assert_true(sheet_has_note(&sheet, "Inputs of radius_m 5, camera 1, full: model city.obj."));
    assert_true(sheet_has_note(&sheet, "Shape on cpu, no_geometry: "));
    assert_false(sheet_has_note(&sheet, "Shape on cpu, full"));
    sheet_expect_text(&sheet, 0, "error, FLIP", "0.0000");
    sheet_expect_text(&sheet, 0, "noise", "");
    rg_sheet_free(&sheet);
    sheet_record_at(&rig, 0, 0)->frame_ms.high *= 1.44;
    sheet_record_at(&rig, 1, 0)->taken[3] = 0.06;
    rg_result_sheet(&rig.result, &sheet);
    sheet_expect_text(&sheet, 0, "noise", "+-20%");
    sheet_expect_text(&sheet, 2, "noise", "busy");
    assert_true(sheet_has_note(&sheet, "Marks: 1 of 5 cells have intervals wider than 1.1 times"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// A fact that all rows share is printed once; rows are called by their names.
static void test_sheet_of_names(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
    for (int row = 0; row < 4; row++)
        sheet_tell(sheet_record_at(&rig, row, 0), "seed", 7);
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet,
                               "Spread of fps on cpu: 10.0 to 50.0, by 80 %; published 120.00 to "
                               "160.00, by 25 %."));
    sheet_expect_text(&sheet, 1, "scene", "dragon");
    sheet_expect_text(&sheet, 1, "published faces", "100000");
    assert_null(sheet_text_at(&sheet, 0, "variant"));
    assert_null(sheet_text_at(&sheet, 0, "error, FLIP"));
    assert_true(sheet_has_note(&sheet, "Inputs of every row: seed 7."));
    assert_true(sheet_has_note(&sheet, "same order. fps keeps the published order (5 of 5 pairs"));
    rg_sheet_free(&sheet);
    sheet_record_at(&rig, 2, 0)->facts[0].number = 8;
    rg_result_sheet(&rig.result, &sheet);
    assert_true(sheet_has_note(&sheet, "Inputs of dragon: seed 7."));
    assert_true(sheet_has_note(&sheet, "Inputs of buddha: seed 8."));
    assert_true(sheet_has_note(&sheet, "Inputs of planck: seed 7."));
    assert_false(sheet_has_note(&sheet, "every row"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

static void test_passes(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
    sheet_add_pass(sheet_record_at(&rig, 0, 0), "flow_move", 2);
    sheet_add_pass(sheet_record_at(&rig, 0, 0), "flow_light", 7);
    sheet_add_pass(sheet_record_at(&rig, 0, 0), "scan_add", 0.98);
    sheet_add_pass(sheet_record_at(&rig, 0, 0), "flow_splat", 0.02);
    for (int i = 0; i < 20; i++)
        sheet_add_pass(sheet_record_at(&rig, 1, 0), "flow_a_rather_long_name", 1);
    rg_result_sheet(&rig.result, &sheet);
    sheet_expect_text(&sheet, 0, "passes, synced", "light 70 %, move 20 %, scan_add 10 %");
    const char *cut = sheet_text_at(&sheet, 1, "passes, synced");
    assert_non_null(strstr(cut, "a_rather_long_name 5 %, a_rather_long_name 5 %, "));
    const char *rest = strstr(cut, ", other ");
    assert_non_null(rest);
    int shown = 0;
    for (const char *at = cut; (at = strstr(at, " 5 %")); at++)
        shown++;
    assert_int_equal(atoi(rest + strlen(", other ")), 100 - 5 * shown);
    sheet_expect_text(&sheet, 2, "passes, synced", "");
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

static const struct rg_table_row levels[] = {
    {"", {0, 32, 3606}, "environment"},
    {"", {1, 16, 1803}, "environment"},
};

static const struct rg_table texture_table = {
    .id = "textures",
    .technique = "flow",
    .hardware = "paper",
    .names = "atlas",
    .columns = {"level", "width_px", "height_px"},
    .key_count = 1,
    .variants = {{"full", "", NULL}},
    .is_of_textures = true,
    .quick = "atlas=small",
    .row_count = 2,
    .rows = levels,
    .note = "a note",
};

// Sizes stand next to the printed ones, and there are no columns of times.
static void test_textures(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &texture_table, (double[]){1, 0});
    sheet_tell(sheet_record_at(&rig, 0, 0), "width_px", 32);
    sheet_tell(sheet_record_at(&rig, 0, 0), "height_px", 3607);
    rg_result_sheet(&rig.result, &sheet);
    sheet_expect_text(&sheet, 0, "atlas", "environment");
    sheet_expect_text(&sheet, 0, "level", "0");
    sheet_expect_text(&sheet, 0, "published height_px", "3606");
    sheet_expect_text(&sheet, 0, "height_px", "3607");
    sheet_expect_text(&sheet, 0, "status", "ok");
    sheet_expect_text(&sheet, 1, "status", "fail");
    sheet_expect_text(&sheet, 1, "height_px", "");
    assert_null(sheet_text_at(&sheet, 0, "fps"));
    assert_null(sheet_text_at(&sheet, 0, "ms"));
    assert_null(sheet_text_at(&sheet, 0, "passes, synced"));
    assert_true(sheet_has_note(&sheet, "Quick mode sets atlas=small"));
    rg_sheet_free(&sheet);
    rig.result.full = true;
    rg_result_sheet(&rig.result, &sheet);
    assert_false(sheet_has_note(&sheet, "Quick mode"));
    rg_sheet_free(&sheet);
    json_int_t width, height, printed;
    json_t *json = rg_result_json(&rig.result);
    assert_int_equal(0, json_unpack(json_array_get(json_object_get(json, "cells"), 0),
                                    "{s{sI, sI!}, s{sI, sI!}}", "measured", "width_px", &width,
                                    "height_px", &height, "published", "width_px", &printed,
                                    "height_px", &printed));
    assert_equals(width, 32);
    assert_equals(height, 3607);
    assert_equals(printed, 3606);
    json_decref(json);
    rg_result_free(&rig.result);
}

static const struct rg_table range_table = {
    .id = "range",
    .technique = "drops",
    .hardware = "paper",
    .columns = {"columns", "merge", "ms_per_frame_min", "ms_per_frame_max"},
    .key_count = 2,
    .has_choices = true,
    .variants = {{"full", "", NULL}},
    .works = {{"paper", "sleep=off", ""}, {"ours", "sleep=on", "less"}},
    .counted = {"drops_stepped"},
    .row_count = 1,
    .rows = (const struct rg_table_row[]){{"", {1000, 1, 10, 25}, NULL}},
    .note = "a note",
};

static void test_range(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &range_table, (double[]){200, 400});
    struct rg_record *paper = sheet_record_at(&rig, 0, 0);
    paper->counted_count = 1;
    paper->counted[0] = (struct rg_count){"drops_stepped", 645};
    rg_result_sheet(&rig.result, &sheet);
    sheet_expect_text(&sheet, 0, "columns", "1000");
    sheet_expect_text(&sheet, 0, "merge", "on");
    sheet_expect_text(&sheet, 0, "published ms_per_frame_min", "10");
    sheet_expect_text(&sheet, 0, "published ms_per_frame_max", "25");
    assert_null(sheet_text_at(&sheet, 0, "published fps"));
    sheet_expect_text(&sheet, 0, "fps / published", "2.00 to 5.00"); // print: 100 to 40 fps
    sheet_expect_text(&sheet, 1, "fps / published", "");
    sheet_expect_text(&sheet, 0, "drops_stepped a frame", "645");
    sheet_expect_text(&sheet, 1, "drops_stepped a frame", "");
    assert_false(sheet_has_note(&sheet, "Shape on cpu"));
    rg_sheet_free(&sheet);
    // The first cell may have failed before anything was counted.
    struct rg_record *ours = rg_result_at(&rig.result, (struct rg_place){.work = 1});
    ours->counted_count = 1;
    ours->counted[0] = paper->counted[0];
    paper->counted_count = 0;
    rg_result_sheet(&rig.result, &sheet);
    sheet_expect_text(&sheet, 0, "drops_stepped a frame", "");
    sheet_expect_text(&sheet, 1, "drops_stepped a frame", "645");
    rg_sheet_free(&sheet);
    char name[256];
    rg_record_row_name(paper, name, sizeof(name));
    assert_string_equal(name, "columns 1000, merge on");
    paper->row[0].number = 1048576;
    rg_record_row_name(paper, name, sizeof(name));
    assert_string_equal(name, "columns 1048576, merge on");
    rg_result_free(&rig.result);
}

// What a cell tells of its times and its work, beside cpu:reference of its row.
static void test_times(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    static const struct {
        int row;
        const char *column, *text;
    } due[] = {{0, "fps", "50.0"},
               {0, "ms", "20.000"},
               {0, "ms, 95 %", "19.992 to 20.008"},
               {0, "first frame ms", "12.3"},
               {0, "API / wall clock", "0.99"},
               {0, "x cpu:reference", "5.0"},
               {1, "x cpu:reference", "1.0"},
               {2, "x cpu:reference", ""}, // the row's reference failed
               {4, "x cpu:reference", "0.5"},
               {4, "API / wall clock", "1.06 untrusted"},
               {6, "API / wall clock", "0.79 untrusted"},
               {0, "items a frame", "123"},
               {0, "records a frame", "45"},
               {0, "fragments a frame", ""}, // the device cannot count them
               {1, "items a frame", ""}};
    sheet_measure_on(&rig, &sheet_names_table, (double[]){50, 10, 10, 0, 11, 22, 20, 20}, 2);
    struct rg_record *first = sheet_record_at(&rig, 0, 0);
    first->first_frame_ms = 12.34;
    first->api_over_wall = 0.987;
    first->has_tally = true;
    first->tally = (struct rg_tally){.items = 123, .records = 45, .fragments = -1};
    sheet_record_at(&rig, 2, 0)->api_over_wall = 1.06;
    sheet_record_at(&rig, 3, 0)->api_over_wall = 0.79;
    rg_result_sheet(&rig.result, &sheet);
    for (size_t i = 0; i < sizeof(due) / sizeof(due[0]); i++)
        sheet_expect_text(&sheet, due[i].row, due[i].column, due[i].text);
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// Printed rates stand behind what else is printed, and a measured value for each of the others. An
// error that is unknown is told by its outcome.
static void test_columns(void **state)
{
    (void)state;
    static const char *const due[] = {"radius_m",
                                      "camera",
                                      "published particles",
                                      "published fps",
                                      "variant",
                                      "device",
                                      "fps",
                                      "noise",
                                      "ms",
                                      "ms, 95 %",
                                      "fps / published",
                                      "x cpu:reference",
                                      "first frame ms",
                                      "API / wall clock",
                                      "particles",
                                      "error, FLIP",
                                      "passes, synced"};
    struct rig rig;
    struct rg_sheet sheet;
    sheet_measure(&rig, &sheet_axis_table, (double[]){40, 80, 20, 40, 10, 10});
    sheet_tell(sheet_record_at(&rig, 2, 1), "particles", 784812.5);
    sheet_record_at(&rig, 0, 0)->truth_error.flip_mask_mean = 0.12345;
    sheet_record_at(&rig, 0, 1)->truth_error.outcome = RG_UNSUPPORTED;
    rg_result_sheet(&rig.result, &sheet);
    assert_int_equal(sheet.column_count, sizeof(due) / sizeof(due[0]));
    for (int c = 0; c < sheet.column_count; c++)
        assert_string_equal(sheet.columns[c], due[c]);
    sheet_expect_text(&sheet, 0, "error, FLIP", "0.1235");
    sheet_expect_text(&sheet, 1, "error, FLIP", "unsupported");
    sheet_expect_text(&sheet, 0, "particles", "");
    sheet_expect_text(&sheet, 5, "particles", "784812.5");
    sheet_expect_text(&sheet, 5, "device", "cpu");
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

static void expect_marks(const struct rig *rig, const char *due)
{
    char text[RG_TITLE_SIZE];
    rg_result_marks(&rig->result, text, sizeof(text));
    assert_string_equal(text, due);
}

// The widest interval and the largest share of all cells are told, and cells that failed are not
// counted.
static void test_marks(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 0, 11, 20});
    expect_marks(&rig, "");
    sheet_record_at(&rig, 0, 0)->taken[3] = 0.07;
    sheet_record_at(&rig, 3, 0)->taken[10] = 0.04;
    expect_marks(&rig, "In 1 of 3 others took over 5 % of the processors (busy, !; up to 7 %).");
    sheet_record_at(&rig, 2, 0)->frame_ms.high *= 1.44;
    sheet_record_at(&rig, 3, 0)->frame_ms.high *= 1.21;
    expect_marks(&rig, "2 of 3 cells have intervals wider than 1.1 times (+-, ~; up to 20 %). In 1 "
                       "of 3 others took over 5 % of the processors (busy, !; up to 7 %).");
    sheet_record_at(&rig, 0, 0)->taken[3] = 0;
    expect_marks(&rig, "2 of 3 cells have intervals wider than 1.1 times (+-, ~; up to 20 %).");
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sheet),  cmocka_unit_test(test_sheet_of_names),
        cmocka_unit_test(test_passes), cmocka_unit_test(test_textures),
        cmocka_unit_test(test_range),  cmocka_unit_test(test_times),
        cmocka_unit_test(test_marks),  cmocka_unit_test(test_columns),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
