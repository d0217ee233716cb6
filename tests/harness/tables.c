// Tables: their published numbers are those of the papers' CSV files, and what is said of measured
// ones. tables FOLDER reads the files there.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/tables/table.h"

static const char *folder;

enum { LINE = 512, MAX_FIELDS = RG_TABLE_VALUES + 1 };

// --- the published numbers ---

extern const struct rg_table rg_table_stuppacher_1; // needs parameters that flow may lack

// Splits a line of CSV without quotes in place.
static int split(char *line, char *fields[MAX_FIELDS])
{
    char *rest = NULL;
    int count = 0;
    for (char *one = strtok_r(line, ",\r\n", &rest); one; one = strtok_r(NULL, ",\r\n", &rest)) {
        assert_true(count < MAX_FIELDS);
        fields[count++] = one;
    }
    return count;
}

// A field of the file is in the table under the same name, and nothing else is.
static void compare_row(const struct rg_table *table, int row, char *names[], char *fields[],
                        int count)
{
    int columns = table->names ? 1 : 0;
    for (int c = 0; table->columns[c]; c++)
        columns++;
    assert_int_equal(columns, count);
    for (int i = 0; i < count; i++) {
        if (table->names && !strcmp(names[i], table->names))
            assert_string_equal(fields[i], table->rows[row].name);
        else if (strtod(fields[i], NULL) != rg_table_value(table, row, names[i]))
            fail_msg("%s, row %d: %s is %s in print, %g in the table", table->id, row + 1, names[i],
                     fields[i], rg_table_value(table, row, names[i]));
    }
}

static void compare(const struct rg_table *table)
{
    char path[1024], header[LINE], line[LINE], *names[MAX_FIELDS], *fields[MAX_FIELDS];
    snprintf(path, sizeof(path), "%s/%s.csv", folder, table->id);
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("%s: cannot be read", path);
    assert_non_null(fgets(header, sizeof(header), file));
    const int count = split(header, names);
    int rows = 0;
    for (; fgets(line, sizeof(line), file); rows++) {
        assert_true(rows < table->row_count);
        assert_int_equal(split(line, fields), count);
        compare_row(table, rows, names, fields, count);
    }
    assert_int_equal(rows, table->row_count);
    fclose(file);
}

static void test_published(void **state)
{
    (void)state;
    assert_non_null(rg_table_find("stuppacher-2"));
    compare(&rg_table_stuppacher_1);
    for (int i = 0; rg_tables[i]; i++)
        if (rg_table_is_published(rg_tables[i]))
            compare(rg_tables[i]);
}

// Every assignment of every table is one that its technique takes, and every variant has its
// column.
static void test_settings(void **state)
{
    (void)state;
    for (int i = 0; rg_tables[i]; i++) {
        const struct rg_table *table = rg_tables[i];
        const struct rg_technique *technique = rg_technique_find(table->technique);
        assert_non_null(technique);
        assert_in_range(table->row_count, 1, RG_TABLE_ROWS);
        assert_in_range(rg_table_variant_count(table), 1, RG_TABLE_VARIANTS);
        assert_true(table->names || table->key_count > 0);
        void *defaults = rg_settings_create(technique);
        for (int j = 0; j < table->row_count * rg_table_variant_count(table); j++) {
            const int row = j % table->row_count, variant = j / table->row_count;
            void *of_row = rg_settings_copy(technique, defaults, table->rows[row].set);
            assert_non_null(of_row);
            void *all = rg_settings_copy(technique, of_row, table->variants[variant].set);
            assert_non_null(all);
            void *quick = rg_settings_copy(technique, all, table->quick ? table->quick : "");
            assert_non_null(quick);
            void *truth = rg_settings_copy(technique, quick, table->truth ? table->truth : "");
            assert_non_null(truth);
            if (table->is_of_textures)
                assert_true(table->rows[row].name && rg_table_value(table, row, "level") >= 0);
            else if (rg_table_is_published(table))
                assert_true(rg_table_published_fps(table, row, variant) > 0);
            free(truth);
            free(quick);
            free(all);
            free(of_row);
        }
        free(defaults);
    }
}

// --- what is said of measured numbers ---

static const struct rg_table_row scenes[] = {
    {"", {6, 160}, "mirror"},
    {"", {100000, 120}, "dragon"},
    {"", {99999, 120}, "buddha"},
    {"", {50801, 146}, "planck"},
};
static const struct rg_table names_table = {
    .id = "names",
    .hardware = "paper",
    .names = "scene",
    .columns = {"faces", "fps"},
    .variants = {{"full", "", "fps"}},
    .row_count = 4,
    .rows = scenes,
    .note = "a note",
};
static const struct rg_table_row radii[] = {
    {"", {5, 1, 70303, 400, 800}, NULL},
    {"", {10, 1, 198818, 200, 400}, NULL},
    {"", {20, 1, 784812, 100, 400}, NULL},
};
static const struct rg_table axis_table = {
    .id = "axis",
    .hardware = "paper",
    .columns = {"radius_m", "camera", "particles", "fps", "fps_no_geometry"},
    .key_count = 2,
    .variants = {{"full", "", "fps"}, {"no_geometry", "geometry=off", "fps_no_geometry"}},
    .truth = "radius_m=0",
    .row_count = 3,
    .rows = radii,
    .note = "a note",
};

static const struct rg_technique technique = {.name = "flow"};
static struct rg_device device = {.info = {.name = "cpu", .software = true}};

// A run on one device as if it had been measured at these frame rates, of the table's rows in turn
// and each row's variants; 0: the cell failed.
struct rig {
    struct rg_devices devices;
    struct rg_table_run run;
    struct rg_cell cells[16];
    struct rg_table_group groups[16];
};

static void measure(struct rig *rig, const struct rg_table *table, const double *fps)
{
    *rig = (struct rig){.devices = {.count = 1, .devices = {&device}}};
    const int count = table->row_count * rg_table_variant_count(table);
    rig->run = (struct rg_table_run){.table = table,
                                     .devices = &rig->devices,
                                     .last_row = table->row_count - 1,
                                     .cell_count = count,
                                     .cells = rig->cells,
                                     .groups = rig->groups};
    for (int i = 0; i < count; i++) {
        const double ms = 1000 / fps[i];
        rig->cells[i] = (struct rg_cell){.technique = &technique,
                                         .device = &device,
                                         .status = fps[i] > 0 ? RG_OK : RG_FAIL,
                                         .detail = "differs",
                                         .frame_ms = {ms, ms, ms}};
    }
}

static struct rg_trend trend_of(const struct rg_table *table, int variant, const double *fps)
{
    struct rig rig;
    measure(&rig, table, fps);
    return rg_table_trend(&rig.run, variant, 0);
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
    assert_int_equal(trend_of(&axis_table, 0, (double[]){40, 1, 41, 1, 38, 1}).verdict,
                     RG_TREND_NOT);
    // The other variant is held against its own column, in which two rows are equal.
    s = trend_of(&axis_table, 1, (double[]){1, 80, 1, 39, 1, 41});
    assert_int_equal(s.verdict, RG_TREND_REPRODUCED);
    assert_int_equal(s.pairs, 2);
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
    rig.cells[0].fact_count = 2;
    rig.cells[0].facts[0] = (struct rg_fact){.name = "particles", .number = 70000};
    rig.cells[0].facts[1] = (struct rg_fact){.name = "model", .text = "city.obj"};
    rg_table_sheet(&rig.run, &sheet);
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
}

// What every row tells is said once; rows are called by their names.
static void test_sheet_of_names(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 10, 11, 20});
    for (int i = 0; i < 4; i++) {
        rig.cells[i].fact_count = 1;
        rig.cells[i].facts[0] = (struct rg_fact){.name = "seed", .number = 7};
    }
    rg_table_sheet(&rig.run, &sheet);
    expect_text(&sheet, 1, "scene", "dragon");
    expect_text(&sheet, 1, "published faces", "100000");
    assert_null(text_at(&sheet, 0, "variant"));
    assert_null(text_at(&sheet, 0, "error, FLIP"));
    assert_true(has_note(&sheet, "Inputs of every row: seed 7."));
    assert_true(has_note(&sheet, "same order. fps keeps the published order (5 of 5 pairs"));
    rg_sheet_free(&sheet);
    rig.cells[2].facts[0].number = 8;
    rg_table_sheet(&rig.run, &sheet);
    assert_true(has_note(&sheet, "Inputs of dragon: seed 7."));
    assert_true(has_note(&sheet, "Inputs of buddha: seed 8."));
    assert_true(has_note(&sheet, "Inputs of planck: seed 7."));
    assert_false(has_note(&sheet, "every row"));
    rg_sheet_free(&sheet);
}

static void test_passes(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 10, 11, 20});
    rig.cells[0].pass_count = 4;
    rig.cells[0].passes[0] = (struct rg_cell_pass){"flow_move", 2};
    rig.cells[0].passes[1] = (struct rg_cell_pass){"flow_light", 7};
    rig.cells[0].passes[2] = (struct rg_cell_pass){"scan_add", 0.98};
    rig.cells[0].passes[3] = (struct rg_cell_pass){"flow_splat", 0.02};
    rig.cells[1].pass_count = 20;
    for (int i = 0; i < 20; i++)
        rig.cells[1].passes[i] = (struct rg_cell_pass){"flow_a_rather_long_name", 1};
    rg_table_sheet(&rig.run, &sheet);
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
}

static void test_json(void **state)
{
    (void)state;
    struct rig rig;
    measure(&rig, &axis_table, (double[]){40, 80, 20, 40, 0, 10});
    rig.cells[1].fact_count = 2;
    rig.cells[1].facts[0] = (struct rg_fact){.name = "particles", .number = 70000};
    rig.cells[1].facts[1] = (struct rg_fact){.name = "model", .text = "no UTF-8: \xff"};
    rig.cells[1].pass_count = 2;
    rig.cells[1].passes[0] = (struct rg_cell_pass){"a", 3};
    rig.cells[1].passes[1] = (struct rg_cell_pass){"b", 1};
    rig.groups[0].error_status = RG_UNSUPPORTED;
    snprintf(rig.groups[0].error_detail, sizeof(rig.groups[0].error_detail), "too much");
    rig.groups[1].error.flip_mask_mean = 0.5;
    snprintf(rig.devices.missing[0], sizeof(rig.devices.missing[0]), "gl: none");
    rig.devices.broken_count = 1;
    snprintf(rig.devices.broken[0].why, sizeof(rig.devices.broken[0].why), "vulkan: broken");
    json_t *json = rg_table_json(&rig.run);
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
}

// --- what was not measured, and what is not timed ---

// Rows behind an interruption are left out, and no shape is told of those that are there.
static void test_missing_rows(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 10, 11, 20});
    rig.groups[2].is_missing = rig.groups[3].is_missing = true;
    rig.run.resumed_rows = 1;
    rg_table_sheet(&rig.run, &sheet);
    assert_int_equal(sheet.row_count, 2);
    assert_true(has_note(&sheet, "Rows 3 to 4 are missing: the run was interrupted."));
    assert_true(has_note(&sheet, "Of its rows, 1 were measured by a run"));
    assert_false(has_note(&sheet, "Shape on cpu"));
    rg_sheet_free(&sheet);
    json_t *json = rg_table_json(&rig.run);
    assert_int_equal(json_array_size(json_object_get(json, "cells")), 2);
    assert_true(json_is_true(json_object_get(json, "interrupted")));
    json_decref(json);
}

static void test_unsupported(void **state)
{
    (void)state;
    struct rig rig;
    struct rg_sheet sheet;
    measure(&rig, &names_table, (double[]){50, 0, 11, 20});
    rig.cells[1].status = RG_UNSUPPORTED;
    rg_table_sheet(&rig.run, &sheet);
    expect_text(&sheet, 1, "fps", "unsupported");
    assert_true(has_note(&sheet, "dragon on cpu: differs"));
    rg_sheet_free(&sheet);
    const char *status;
    json_t *json = rg_table_json(&rig.run);
    assert_int_equal(0, json_unpack(json_array_get(json_object_get(json, "cells"), 1), "{ss}",
                                    "status", &status));
    assert_string_equal(status, "unsupported");
    json_decref(json);
}

static const struct rg_table_row levels[] = {
    {"", {0, 32, 3606}, "environment"},
    {"", {1, 16, 1803}, "environment"},
};
static const struct rg_table texture_table = {
    .id = "textures",
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
    rig.cells[0].fact_count = 2;
    rig.cells[0].facts[0] = (struct rg_fact){.name = "width_px", .number = 32};
    rig.cells[0].facts[1] = (struct rg_fact){.name = "height_px", .number = 3607};
    rg_table_sheet(&rig.run, &sheet);
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
    rig.run.full = true;
    rg_table_sheet(&rig.run, &sheet);
    assert_false(has_note(&sheet, "Quick mode"));
    rg_sheet_free(&sheet);
    json_int_t width, height, printed;
    json_t *json = rg_table_json(&rig.run);
    assert_int_equal(0, json_unpack(json_array_get(json_object_get(json, "cells"), 0),
                                    "{s{sI, sI!}, s{sI, sI!}}", "measured", "width_px", &width,
                                    "height_px", &height, "published", "width_px", &printed,
                                    "height_px", &printed));
    assert_true(width == 32 && height == 3607 && printed == 3606);
    json_decref(json);
}

int main(int argc, char **argv)
{
    folder = argc > 1 ? argv[1] : "results/published";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_published),      cmocka_unit_test(test_settings),
        cmocka_unit_test(test_order_of_names), cmocka_unit_test(test_slope_along_axis),
        cmocka_unit_test(test_sheet),          cmocka_unit_test(test_sheet_of_names),
        cmocka_unit_test(test_passes),         cmocka_unit_test(test_json),
        cmocka_unit_test(test_missing_rows),   cmocka_unit_test(test_unsupported),
        cmocka_unit_test(test_textures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
