// What is said of measured tables: trends, sheets for people, machine forms.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/sheet/sheet.h"
#include "harness/tables/table.h"
#include "harness/tables/sheet/trend.h"

// --- what is said of measured numbers ---

static const struct rg_table_row scenes[] = {
    {"", {6, 160}, "mirror"},
    {"", {100000, 120}, "dragon"},
    {"", {99999, 120}, "buddha"},
    {"", {50801, 146}, "planck"},
};
static const struct rg_table names_table = {
    .id = "names",
    .technique = "flow",
    .hardware = "paper",
    .names = "scene",
    .columns = {"faces", "fps"},
    .variants = {{"full", "", "fps"}},
    .row_count = 4,
    .rows = scenes,
    .note = "a note",
};
// Named rows of no paper: the first has all on.
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
static const struct rg_table styles_table = {
    .id = "styles",
    .technique = "flow",
    .hardware = "paper",
    .names = "scene",
    .columns = {"fps", "fps_no_geometry"},
    .variants = {{"full", "", "fps"}, {"no_geometry", "geometry=off", "fps_no_geometry"}},
    .works = {{"paper", "blocks=all", ""}, {"ours", "", "less is drawn"}},
    .row_count = 2,
    .rows = (const struct rg_table_row[]){{"", {100, 200}, "mirror"}, {"", {80, 190}, "dragon"}},
    .note = "a note",
};
static const struct rg_table_row radii[] = {
    {"", {5, 1, 70303, 400, 800}, NULL},
    {"", {10, 1, 198818, 200, 400}, NULL},
    {"", {20, 1, 784812, 100, 400}, NULL},
};
static const struct rg_table axis_table = {
    .id = "axis",
    .technique = "flow",
    .hardware = "paper",
    .columns = {"radius_m", "camera", "particles", "fps", "fps_no_geometry"},
    .key_count = 2,
    .variants = {{"full", "", "fps"}, {"no_geometry", "geometry=off", "fps_no_geometry"}},
    .truth = "radius_m=0",
    .row_count = 3,
    .rows = radii,
    .note = "a note",
};

static struct rg_device device = {.info = {.name = "cpu", .software = true}};

// A result on one device as if it had been measured at these frame rates, of the table's rows in
// turn and each row's works and variants; 0: the cell failed.
struct rig {
    struct rg_devices devices;
    struct rg_result result;
};

static void measure_few(struct rig *rig, const struct rg_table *table, const double *fps,
                        int samples)
{
    const struct rg_table_part part = {.last_row = table->row_count - 1};
    rig->devices = (struct rg_devices){.count = 1, .devices = {&device}};
    rig->result = (struct rg_result){0};
    rg_table_begin(&rig->result, table, &part, &rig->devices);
    for (int row = 0; row < table->row_count; row++)
        assert_true(rg_table_add_row(&rig->result, table, row));
    for (struct rg_place at = rg_result_start(&rig->result); rg_result_next(&rig->result, &at);) {
        struct rg_record *record = rg_result_at(&rig->result, at);
        const double ms = 1000 / *fps;
        record->outcome = *fps++ > 0 ? RG_OK : RG_FAIL;
        snprintf(record->detail, sizeof(record->detail), "differs");
        record->frame_ms.median = ms; // also of a cell that failed
        record->sample_count = record->outcome == RG_OK ? samples : 0;
        for (int i = 0; i < record->sample_count; i++)
            record->samples_ms[i] = ms * (1 + 1e-4 * (i - samples / 2));
        rg_record_settle(record);
    }
}

static void measure(struct rig *rig, const struct rg_table *table, const double *fps)
{
    measure_few(rig, table, fps, 11);
}

// The record of a row and variant.
static struct rg_record *record_at(const struct rig *rig, int row, int variant)
{
    return rg_result_at(&rig->result, (struct rg_place){.row = row, .variant = variant});
}

static void tell(struct rg_record *record, const char *name, double number)
{
    rg_named_set_number(&record->facts[record->fact_count++], name, number);
}

static void add_pass(struct rg_record *record, const char *name, double ms)
{
    struct rg_pass_time *pass = &record->passes[record->pass_count++];
    pass->ms = ms;
    rg_text_copy(pass->name, sizeof(pass->name), name);
}

static struct rg_trend trend_of(const struct rg_table *table, int variant, const double *fps)
{
    struct rig rig;
    measure(&rig, table, fps);
    const struct rg_trend trend = rg_trend_of(&rig.result, (struct rg_place){.variant = variant});
    rg_result_free(&rig.result);
    return trend;
}

static void test_order_of_names(void **state)
{
    (void)state;
    // Equal in print: dragon and buddha may stand in any order.
    struct rg_trend s = trend_of(&names_table, 0, (double[]){50, 10, 11, 20});
    assert_int_equal(s.verdict, RG_TREND_ORDER);
    assert_int_equal(s.pairs, 5);
    assert_int_equal(s.pairs_in_order, 5);
    assert_false(s.has_slope);
    assert_int_equal(trend_of(&names_table, 0, (double[]){50, 11, 10, 20}).verdict, RG_TREND_ORDER);
    s = trend_of(&names_table, 0, (double[]){50, 30, 10, 20}); // the dragon before Planck
    assert_int_equal(s.verdict, RG_TREND_NOT);
    assert_int_equal(s.pairs_in_order, 4);
    s = trend_of(&names_table, 0, (double[]){50, 0, 10, 20});
    assert_int_equal(s.verdict, RG_TREND_UNKNOWN);
}

// Two cameras, each with three rows: no row is held against one of the other camera.
static void test_groups(void **state)
{
    (void)state;
    static const struct rg_table_row rows[] = {
        {"", {5, 1, 1, 400, 1}, NULL},  {"", {10, 1, 1, 200, 1}, NULL},
        {"", {20, 1, 1, 100, 1}, NULL}, {"", {5, 2, 1, 40, 1}, NULL},
        {"", {10, 2, 1, 20, 1}, NULL},  {"", {20, 2, 1, 10, 1}, NULL}};
    struct rg_table table = axis_table;
    table.rows = rows;
    table.row_count = 6;
    // The second camera is faster here.
    struct rg_trend s =
        trend_of(&table, 0, (double[]){40, 1, 20, 1, 10, 1, 400, 1, 200, 1, 100, 1});
    assert_int_equal(s.verdict, RG_TREND_REPRODUCED);
    assert_int_equal(s.pairs, 6);
    assert_float_equal(s.slope, -1, 1e-6);
    assert_float_equal(s.published_slope, -1, 1e-9);
    // Where each row has another value of the second key, that goes with the axis.
    struct rg_table_row single[] = {rows[0], rows[1], rows[2]};
    for (int i = 0; i < 3; i++)
        single[i].values[1] = i;
    table.rows = single;
    table.row_count = 3;
    s = trend_of(&table, 0, (double[]){40, 1, 20, 1, 10, 1});
    assert_int_equal(s.pairs, 3);
    assert_float_equal(s.slope, -1, 1e-6);
}

// Of three pairs one is other than in print: the samples must settle that, or the verdict is open.
static void test_unsettled_order(void **state)
{
    (void)state;
    struct rg_trend s = trend_of(&axis_table, 0, (double[]){40, 1, 20, 1, 19.999, 1});
    assert_int_equal(s.verdict, RG_TREND_UNDECIDED);
    assert_int_equal(s.pairs_in_order, 3);
    assert_int_equal(s.pairs_undecided, 1);
    s = trend_of(&axis_table, 0, (double[]){40, 1, 20, 1, 20.001, 1});
    assert_int_equal(s.verdict, RG_TREND_UNDECIDED);
    assert_int_equal(s.pairs_in_order, 2);
    assert_int_equal(trend_of(&axis_table, 0, (double[]){40, 1, 20, 1, 20.1, 1}).verdict,
                     RG_TREND_NOT);
}

static void test_slope_along_axis(void **state)
{
    (void)state;
    // Variant by variant: full, no_geometry.
    struct rg_trend s = trend_of(&axis_table, 0, (double[]){40, 1, 20, 1, 10, 1});
    assert_int_equal(s.verdict, RG_TREND_REPRODUCED);
    assert_true(s.has_slope);
    assert_float_equal(s.slope, -1, 1e-9);
    assert_float_equal(s.published_slope, -1, 1e-9);
    s = trend_of(&axis_table, 0, (double[]){40, 1, 39, 1, 38, 1});
    assert_int_equal(s.verdict, RG_TREND_ONLY);
    s = trend_of(&axis_table, 0, (double[]){90, 1, 30, 1, 10, 1}); // too fast
    assert_int_equal(s.verdict, RG_TREND_ONLY);
    assert_int_equal(trend_of(&axis_table, 0, (double[]){40, 1, 41, 1, 38, 1}).verdict,
                     RG_TREND_NOT);
    // The other variant is held against its own column, in which two rows are equal.
    s = trend_of(&axis_table, 1, (double[]){1, 80, 1, 39, 1, 41});
    assert_int_equal(s.verdict, RG_TREND_REPRODUCED);
    assert_int_equal(s.pairs, 2);
}

// A row that draws more than 1.2 times the particles in print takes no part; nor does anything
// where settings were changed.
static void test_other_work(void **state)
{
    (void)state;
    struct rig rig;
    const struct rg_place full = {0};
    measure(&rig, &axis_table, (double[]){40, 1, 200, 1, 10, 1});
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_NOT);
    tell(record_at(&rig, 1, 0), "particles", 198818 * 1.19);
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_NOT);
    record_at(&rig, 1, 0)->facts[0].number = 198818 * 1.21;
    const struct rg_trend trend = rg_trend_of(&rig.result, full);
    assert_int_equal(trend.verdict, RG_TREND_REPRODUCED);
    assert_int_equal(trend.pairs, 1);
    snprintf(rig.result.changed, sizeof(rig.result.changed), "seed=2");
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_OTHER_WORK);
    rg_result_free(&rig.result);
}

// Of each work the cells of one variant stay, those of the other leave.
static void test_keeping_a_variant(void **state)
{
    (void)state;
    struct rig rig;
    measure(&rig, &styles_table, (double[]){11, 12, 13, 14, 21, 22, 23, 24});
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
    const struct rg_devices devices = {.count = 1, .devices = {&device}};
    const struct rg_table_part part = {
        .last_row = 0, .variant = "no_geometry", .work = "paper", .set = "seed=2"};
    struct rg_result result = {0};
    rg_table_begin(&result, &styles_table, &part, &devices);
    assert_true(rg_table_add_row(&result, &styles_table, 0));
    const struct rg_record *record = rg_result_at(&result, (struct rg_place){0});
    assert_int_equal(rg_result_row_cells(&result), 1);
    assert_string_equal(record->variant, "no_geometry");
    assert_string_equal(record->set, "geometry=off blocks=all seed=2");
    assert_float_equal(rg_record_published_fps(record), 200, 0);
    assert_string_equal(result.changed, "seed=2");
    rg_result_free(&result);
}

static const char *text_at(const struct rg_sheet *sheet, int row, const char *column)
{
    for (int c = 0; c < sheet->column_count; c++)
        if (!strcmp(sheet->columns[c], column))
            return sheet->cells[row][c];
    return NULL;
}

static void expect_text(const struct rg_sheet *sheet, int row, const char *column, const char *text)
{
    const char *found = text_at(sheet, row, column);
    if (!found || strcmp(found, text))
        fail_msg("row %d, %s: '%s', not '%s'", row, column, found ? found : "no column", text);
}

static bool has_note(const struct rg_sheet *sheet, const char *text)
{
    for (int n = 0; n < sheet->note_count; n++)
        if (strstr(sheet->notes[n], text))
            return true;
    return false;
}

static void test_sheet(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &axis_table, (double[]){40, 80, 20, 40, 0, 10});
    tell(record_at(&rig, 0, 0), "particles", 70000);
    rg_named_set_text(&record_at(&rig, 0, 0)->facts[1], "model", "city.obj");
    record_at(&rig, 0, 0)->fact_count = 2;
    rg_result_sheet(&rig.result, &sheet);
    assert_int_equal(sheet.row_count, 6);
    assert_string_equal(sheet.columns[0], "radius_m");
    assert_string_equal(sheet.columns[1], "camera");
    expect_text(&sheet, 1, "radius_m", "5");
    expect_text(&sheet, 1, "published particles", "70303");
    expect_text(&sheet, 0, "particles", "70000");
    expect_text(&sheet, 0, "published fps", "400");
    expect_text(&sheet, 1, "published fps", "800");
    expect_text(&sheet, 1, "variant", "no_geometry");
    expect_text(&sheet, 1, "fps / published", "0.10");
    expect_text(&sheet, 4, "fps", "fail");
    assert_true(has_note(&sheet, "radius_m 20, camera 1, full on cpu: differs"));
    assert_true(has_note(&sheet, "Inputs of radius_m 5, camera 1, full: model city.obj."));
    assert_true(has_note(&sheet, "Shape on cpu, no_geometry: "));
    assert_false(has_note(&sheet, "Shape on cpu, full"));
    expect_text(&sheet, 0, "error, FLIP", "0.0000");
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// What a part costs is what a frame takes without it.
static void test_costs(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &parts_table, (double[]){50, 100, 40});
    record_at(&rig, 1, 0)->truth_error.flip_mask_mean = 0.25;
    rg_result_sheet(&rig.result, &sheet);
    assert_true(has_note(&sheet,
                         "Cost on cpu: of the time of a frame of `all`, one of these takes: "
                         "no merging 0.50 (FLIP 0.250), none 1.25 (FLIP 0.000)."));
    rg_sheet_free(&sheet);
    record_at(&rig, 2, 0)->outcome = RG_FAIL;
    rg_result_sheet(&rig.result, &sheet);
    assert_false(has_note(&sheet, "Cost on cpu"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// What every row tells is said once; rows are called by their names.
static void test_sheet_of_names(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 10, 11, 20});
    for (int row = 0; row < 4; row++)
        tell(record_at(&rig, row, 0), "seed", 7);
    rg_result_sheet(&rig.result, &sheet);
    assert_true(has_note(&sheet, "Spread of fps on cpu: 10.0 to 50.0, by 80 %; published 120.00 to "
                                 "160.00, by 25 %."));
    expect_text(&sheet, 1, "scene", "dragon");
    expect_text(&sheet, 1, "published faces", "100000");
    assert_null(text_at(&sheet, 0, "variant"));
    assert_null(text_at(&sheet, 0, "error, FLIP"));
    assert_true(has_note(&sheet, "Inputs of every row: seed 7."));
    assert_true(has_note(&sheet, "same order. fps keeps the published order (5 of 5 pairs"));
    rg_sheet_free(&sheet);
    record_at(&rig, 2, 0)->facts[0].number = 8;
    rg_result_sheet(&rig.result, &sheet);
    assert_true(has_note(&sheet, "Inputs of dragon: seed 7."));
    assert_true(has_note(&sheet, "Inputs of buddha: seed 8."));
    assert_true(has_note(&sheet, "Inputs of planck: seed 7."));
    assert_false(has_note(&sheet, "every row"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

static void test_passes(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 10, 11, 20});
    add_pass(record_at(&rig, 0, 0), "flow_move", 2);
    add_pass(record_at(&rig, 0, 0), "flow_light", 7);
    add_pass(record_at(&rig, 0, 0), "scan_add", 0.98);
    add_pass(record_at(&rig, 0, 0), "flow_splat", 0.02);
    for (int i = 0; i < 20; i++)
        add_pass(record_at(&rig, 1, 0), "flow_a_rather_long_name", 1);
    rg_result_sheet(&rig.result, &sheet);
    expect_text(&sheet, 0, "passes, synced", "light 70 %, move 20 %, scan_add 10 %");
    const char *cut = text_at(&sheet, 1, "passes, synced");
    assert_non_null(strstr(cut, "a_rather_long_name 5 %, a_rather_long_name 5 %, "));
    const char *rest = strstr(cut, ", other ");
    assert_non_null(rest);
    int shown = 0;
    for (const char *at = cut; (at = strstr(at, " 5 %")); at++)
        shown++;
    assert_int_equal(atoi(rest + strlen(", other ")), 100 - 5 * shown);
    expect_text(&sheet, 2, "passes, synced", "");
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

static void test_json(void **state)
{
    (void)state;
    struct rig rig;
    measure(&rig, &axis_table, (double[]){40, 80, 20, 40, 0, 10});
    struct rg_record *second = record_at(&rig, 0, 1);
    tell(second, "particles", 70000);
    rg_named_set_text(&second->facts[second->fact_count++], "model", "no UTF-8: \xff");
    add_pass(second, "a", 3);
    add_pass(second, "b", 1);
    record_at(&rig, 0, 0)->truth_error =
        (struct rg_truth_error){.outcome = RG_UNSUPPORTED, .detail = "too much"};
    second->truth_error.flip_mask_mean = 0.5;
    rig.result.missing_count = 2;
    snprintf(rig.result.missing[0], sizeof(rig.result.missing[0]), "gl: none");
    snprintf(rig.result.missing[1], sizeof(rig.result.missing[1]), "vulkan: broken");
    json_t *json = rg_result_json(&rig.result);
    assert_non_null(json);
    const char *set, *variant, *model, *detail, *missing, *broken, *status;
    json_int_t radius, camera, fps, printed, told, fact;
    double a, b, measured_fps, flip;
    json_t *cells = json_object_get(json, "cells");
    assert_int_equal(json_array_size(cells), 6);
    json_t *cell = json_array_get(cells, 1);
    assert_int_equal(0, json_unpack(cell, "{ss, ss, s{sI, sI}, s{sI, sI}, s{sI, ss}}", "set", &set,
                                    "variant", &variant, "row", "radius_m", &radius, "camera",
                                    &camera, "published", "fps", &fps, "particles", &printed,
                                    "facts", "particles", &fact, "model", &model));
    assert_int_equal(0, json_unpack(cell, "{s{sF, sI, s{sF, sF}}, s{sF}}", "measured", "fps",
                                    &measured_fps, "particles", &told, "passes_share", "a", &a, "b",
                                    &b, "error", "flip_mask_mean", &flip));
    assert_int_equal(0, json_unpack(json, "{s[ss]}", "missing", &missing, &broken));
    assert_int_equal(0, json_unpack(json_array_get(cells, 4), "{ss}", "detail", &detail));
    assert_string_equal(set, "geometry=off");
    assert_string_equal(variant, "no_geometry");
    assert_true(radius == 5 && camera == 1 && fps == 800 && printed == 70303);
    assert_true(told == 70000 && fact == 70000);
    assert_string_equal(model, "no UTF-8: ?");
    assert_string_equal(missing, "gl: none");
    assert_string_equal(broken, "vulkan: broken");
    assert_string_equal(detail, "differs");
    assert_float_equal(measured_fps, 80, 1e-9);
    assert_true(a == 0.75 && b == 0.25 && flip == 0.5);
    assert_int_equal(0, json_unpack(json_array_get(cells, 0), "{s{ss, ss}}", "error", "status",
                                    &status, "detail", &detail));
    assert_string_equal(status, "unsupported");
    assert_string_equal(detail, "too much");
    assert_null(json_object_get(json_array_get(cells, 4), "measured"));
    json_decref(json);
    rg_result_free(&rig.result);
}

// --- what was not measured, and what is not timed ---

// Rows behind an interruption are left out, and no shape is told of those that are there.
static void test_missing_rows(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 10, 11, 20});
    rg_result_drop_row(&rig.result, 2);
    rg_result_drop_row(&rig.result, 3);
    rig.result.resumed_rows = 1;
    rg_result_sheet(&rig.result, &sheet);
    assert_int_equal(sheet.row_count, 2);
    assert_true(has_note(&sheet, "Rows 3 to 4 are missing: the run was interrupted."));
    assert_true(has_note(&sheet, "Of its rows, 1 were measured by a run"));
    assert_false(has_note(&sheet, "Shape on cpu"));
    rg_sheet_free(&sheet);
    json_t *json = rg_result_json(&rig.result);
    assert_int_equal(json_array_size(json_object_get(json, "cells")), 2);
    assert_true(json_is_true(json_object_get(json, "interrupted")));
    json_decref(json);
    rg_result_free(&rig.result);
}

static void test_unsupported(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 0, 11, 20});
    record_at(&rig, 1, 0)->outcome = RG_UNSUPPORTED;
    rg_result_sheet(&rig.result, &sheet);
    expect_text(&sheet, 1, "fps", "unsupported");
    assert_true(has_note(&sheet, "dragon on cpu: differs"));
    rg_sheet_free(&sheet);
    const char *status;
    json_t *json = rg_result_json(&rig.result);
    assert_int_equal(0, json_unpack(json_array_get(json_object_get(json, "cells"), 1), "{ss}",
                                    "status", &status));
    assert_string_equal(status, "unsupported");
    json_decref(json);
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

// Sizes stand beside those in print, and no columns of time.
static void test_textures(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &texture_table, (double[]){1, 0});
    tell(record_at(&rig, 0, 0), "width_px", 32);
    tell(record_at(&rig, 0, 0), "height_px", 3607);
    rg_result_sheet(&rig.result, &sheet);
    expect_text(&sheet, 0, "atlas", "environment");
    expect_text(&sheet, 0, "level", "0");
    expect_text(&sheet, 0, "published height_px", "3606");
    expect_text(&sheet, 0, "height_px", "3607");
    expect_text(&sheet, 0, "status", "ok");
    expect_text(&sheet, 1, "status", "fail");
    expect_text(&sheet, 1, "height_px", "");
    assert_null(text_at(&sheet, 0, "fps"));
    assert_null(text_at(&sheet, 0, "ms"));
    assert_null(text_at(&sheet, 0, "passes, synced"));
    assert_true(has_note(&sheet, "Quick mode sets atlas=small"));
    rg_sheet_free(&sheet);
    rig.result.full = true;
    rg_result_sheet(&rig.result, &sheet);
    assert_false(has_note(&sheet, "Quick mode"));
    rg_sheet_free(&sheet);
    json_int_t width, height, printed;
    json_t *json = rg_result_json(&rig.result);
    assert_int_equal(0, json_unpack(json_array_get(json_object_get(json, "cells"), 0),
                                    "{s{sI, sI!}, s{sI, sI!}}", "measured", "width_px", &width,
                                    "height_px", &height, "published", "width_px", &printed,
                                    "height_px", &printed));
    assert_true(width == 32 && height == 3607 && printed == 3606);
    json_decref(json);
    rg_result_free(&rig.result);
}

// --- tables of no paper ---

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

// Of fewer than six samples nothing is decided, and no interval is printed.
static void test_few_samples(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    for (int samples = 5; samples <= 6; samples++) {
        measure_few(&rig, &axis_table, (double[]){40, 1, 20, 1, 10, 1}, samples);
        const struct rg_trend s = rg_trend_of(&rig.result, (struct rg_place){0});
        assert_int_equal(s.verdict, samples < 6 ? RG_TREND_UNDECIDED : RG_TREND_REPRODUCED);
        assert_int_equal(s.pairs_undecided, samples < 6 ? 3 : 0);
        assert_true(!isfinite(s.slope_low) == (samples < 6));
        rg_result_sheet(&rig.result, &sheet);
        const char *interval = text_at(&sheet, 0, "ms, 95 %");
        assert_non_null(interval);
        assert_true(!*interval == (samples < 6));
        rg_sheet_free(&sheet);
        json_t *json = rg_result_json(&rig.result);
        assert_non_null(json);
        const json_t *measured =
            json_object_get(json_array_get(json_object_get(json, "cells"), 0), "measured");
        assert_true(json_is_null(json_object_get(measured, "ms_low")) == (samples < 6));
        assert_true(json_is_null(json_object_get(measured, "ms_high")) == (samples < 6));
        json_decref(json);
        rg_result_free(&rig.result);
    }
}

// A row that was measured while the machine was a tenth slower may be slower for that.
static void test_drift(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    const struct rg_place full = {0};
    measure(&rig, &axis_table, (double[]){40, 1, 20, 1, 19, 1});
    for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);) {
        struct rg_record *record = rg_result_at(&rig.result, at);
        record->calibration_begin_ms = at.row == 2 ? 2.1 : 2;
        record->calibration_end_ms = at.row == 2 ? 2.3 : 2;
    }
    assert_int_equal(rg_trend_of(&rig.result, full).verdict, RG_TREND_UNDECIDED);
    assert_int_equal(rg_trend_of(&rig.result, full).pairs_undecided, 1);
    assert_float_equal(rg_result_drift(&rig.result), 0.15, 1e-9);
    rg_result_sheet(&rig.result, &sheet);
    assert_true(has_note(&sheet, "drifted by 15.0 % over the run"));
    rg_sheet_free(&sheet);
    record_at(&rig, 2, 0)->calibration_begin_ms = record_at(&rig, 2, 0)->calibration_end_ms = 2;
    assert_int_equal(rg_trend_of(&rig.result, full).pairs_undecided, 0);
    rg_result_free(&rig.result);
}

// The exponent of the time of a frame, which another program reckons, with its interval.
static void test_growth(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    const double fps[] = {1000 / 1., 1000 / 2.2, 1000 / 3.9, 1000 / 8.1};
    measure(&rig, &growth_table, fps);
    const struct rg_trend s = rg_trend_of(&rig.result, (struct rg_place){.row = 0});
    assert_int_equal(s.verdict, RG_TREND_GROWTH);
    assert_true(s.has_slope);
    assert_float_equal(s.slope, -0.29740970, 1e-7);
    assert_float_equal(s.slope_low, s.slope, 2e-4);
    assert_float_equal(s.slope_high, s.slope, 2e-4);
    rg_result_sheet(&rig.result, &sheet);
    assert_true(has_note(&sheet, "Growth on cpu: the time of a frame goes with drops to the power "
                                 "0.30 (95 %: 0.30 to 0.30)."));
    assert_false(has_note(&sheet, "Shape on cpu"));
    rg_sheet_free(&sheet);
    json_t *trends = rg_trends_json(&rig.result);
    const char *verdict;
    double low, high;
    assert_int_equal(0, json_unpack(trends, "[{ss, sF, sF, sn}]", "verdict", &verdict, "slope_low",
                                    &low, "slope_high", &high, "published_slope"));
    assert_string_equal(verdict, "growth");
    assert_true(low < s.slope && s.slope < high);
    json_decref(trends);
    rg_result_free(&rig.result);
}

// Two rows have a line, and an interval by their samples; a row without a time leaves nothing to
// say.
static void test_growth_of_few_rows(void **state)
{
    (void)state;
    struct rg_table two = growth_table;
    struct rig rig;
    struct rg_sheet sheet;
    two.row_count = 2;
    measure(&rig, &two, (double[]){1000, 100});
    rg_result_sheet(&rig.result, &sheet);
    assert_true(has_note(&sheet, "goes with drops to the power 1.00 (95 %: 1.00 to 1.00)."));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
    assert_int_equal(trend_of(&growth_table, 0, (double[]){9, 0, 3, 1}).verdict, RG_TREND_UNKNOWN);
}

// --- printed times, switches and counters ---

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
    measure(&rig, &range_table, (double[]){200, 400});
    struct rg_record *paper = record_at(&rig, 0, 0);
    paper->counted_count = 1;
    paper->counted[0] = (struct rg_count){"drops_stepped", 645};
    rg_result_sheet(&rig.result, &sheet);
    expect_text(&sheet, 0, "columns", "1000");
    expect_text(&sheet, 0, "merge", "on");
    expect_text(&sheet, 0, "published ms_per_frame_min", "10");
    expect_text(&sheet, 0, "published ms_per_frame_max", "25");
    assert_null(text_at(&sheet, 0, "published fps"));
    expect_text(&sheet, 0, "fps / published", "2.00 to 5.00"); // of 100 to 40 frames a second
    expect_text(&sheet, 1, "fps / published", "");
    expect_text(&sheet, 0, "drops_stepped a frame", "645");
    expect_text(&sheet, 1, "drops_stepped a frame", "");
    assert_false(has_note(&sheet, "Shape on cpu"));
    rg_sheet_free(&sheet);
    char name[256];
    rg_record_row_name(paper, name, sizeof(name));
    assert_string_equal(name, "columns 1000, merge on");
    rg_result_free(&rig.result);
}

// Over rows and variants, and the most over the rows of one. What saves work is not held against
// print.
static void test_spread(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &styles_table, (double[]){50, 100, 60, 110, 45, 50, 60, 110});
    rg_result_sheet(&rig.result, &sheet);
    assert_true(has_note(&sheet, "Spread of fps on cpu, paper: 45.0 to 100.0, by 55 %, over the "
                                 "rows of a variant by up to 50 %; published 80.00 to 200.00, by "
                                 "60 %, over the rows of a variant by up to 20 %."));
    assert_true(has_note(&sheet,
                         "Spread of fps on cpu, ours: 60.0 to 110.0, by 45 %, over the rows "
                         "of a variant by up to 0 %."));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
    measure(&rig, &styles_table, (double[]){50, 100, 60, 110, 0, 50, 60, 110});
    rg_result_sheet(&rig.result, &sheet);
    assert_false(has_note(&sheet, "Spread of fps on cpu, paper"));
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

// --- works ---

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

// What saves work stands beside what was printed, and is not held against it.
static void test_works(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &works_table, (double[]){40, 80, 20, 60, 10, 50});
    rg_result_sheet(&rig.result, &sheet);
    assert_int_equal(sheet.row_count, 6);
    expect_text(&sheet, 0, "work", "paper");
    expect_text(&sheet, 0, "fps / published", "0.10");
    expect_text(&sheet, 1, "work", "ours");
    expect_text(&sheet, 1, "fps", "80.0");
    expect_text(&sheet, 1, "fps / published", "");
    assert_false(has_note(&sheet, "Spread of fps")); // its rows have no names
    assert_true(has_note(&sheet, "Shape on cpu, paper: reproduced."));
    assert_false(has_note(&sheet, "Shape on cpu, ours"));
    assert_true(has_note(&sheet, "less is drawn"));
    rg_sheet_free(&sheet);
    struct rg_place ours = {.work = 1};
    assert_string_equal(rg_result_at(&rig.result, ours)->set, "a=1 panes=mirror");
    assert_int_equal(rg_trend_of(&rig.result, ours).verdict, RG_TREND_OTHER_WORK);
    assert_string_equal(record_at(&rig, 1, 0)->set, "a=2 panes=mirror blocks=all");
    // One of them alone.
    assert_false(rg_result_keep_work(&rig.result, "theirs"));
    assert_true(rg_result_keep_work(&rig.result, "ours"));
    assert_int_equal(rg_result_row_cells(&rig.result), 1);
    assert_float_equal(rg_record_fps(record_at(&rig, 2, 0)), 50, 1e-9);
    assert_string_equal(record_at(&rig, 2, 0)->work, "ours");
    rg_result_free(&rig.result);
    // As it is measured.
    const struct rg_table_part part = {.last_row = 2, .work = "paper"};
    rg_table_begin(&rig.result, &works_table, &part, &rig.devices);
    assert_int_equal(rig.result.work_count, 1);
    assert_string_equal(rig.result.works[0].name, "paper");
    rg_result_free(&rig.result);
}

// Rows and works that are left out, and what has none of them.
static void test_keeping(void **state)
{
    (void)state;
    struct rig rig;
    measure(&rig, &axis_table, (double[]){40, 80, 20, 40, 10, 10});
    assert_true(rg_result_keep_work(&rig.result, "paper")); // it tells no works apart
    assert_int_equal(rg_result_row_cells(&rig.result), 2);
    assert_true(rg_result_keep_rows(&rig.result, 1, 5));
    assert_int_equal(rig.result.first_row, 1);
    assert_int_equal(rig.result.last_row, 2);
    assert_float_equal(rg_record_fps(record_at(&rig, 1, 1)), 40, 1e-9);
    assert_float_equal(rg_record_fps(record_at(&rig, 2, 0)), 10, 1e-9);
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
        cmocka_unit_test(test_order_of_names),
        cmocka_unit_test(test_slope_along_axis),
        cmocka_unit_test(test_few_samples),
        cmocka_unit_test(test_drift),
        cmocka_unit_test(test_groups),
        cmocka_unit_test(test_unsettled_order),
        cmocka_unit_test(test_sheet),
        cmocka_unit_test(test_costs),
        cmocka_unit_test(test_sheet_of_names),
        cmocka_unit_test(test_passes),
        cmocka_unit_test(test_json),
        cmocka_unit_test(test_missing_rows),
        cmocka_unit_test(test_unsupported),
        cmocka_unit_test(test_textures),
        cmocka_unit_test(test_works),
        cmocka_unit_test(test_keeping),
        cmocka_unit_test(test_other_work),
        cmocka_unit_test(test_keeping_a_variant),
        cmocka_unit_test(test_part_of_one_variant),
        cmocka_unit_test(test_growth),
        cmocka_unit_test(test_growth_of_few_rows),
        cmocka_unit_test(test_range),
        cmocka_unit_test(test_spread),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
