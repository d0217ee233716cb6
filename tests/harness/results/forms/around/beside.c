// Brief tables with each device beside print: their columns and cells.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/tables/sheet/beside.h"
#include "tests/harness/results/forms/rig.h"

static const struct rg_beside_layout whole = {4, RG_BESIDE_TEXTS, false, false};

// The sheet of a work and a variant; the caller frees it.
static struct rg_sheet made(const struct rig *rig, int work, int variant)
{
    struct rg_sheet sheet;
    const struct rg_place of = {.work = work, .variant = variant};
    rg_beside_make(&rig->result, of, &whole, &sheet);
    assert_false(sheet.incomplete);
    return sheet;
}

// The headings, or the cells of a row, with bars between them.
static void expect_line(const struct rg_sheet *sheet, int row, const char *due)
{
    char text[1024] = "";
    for (int c = 0; c < sheet->column_count; c++) {
        const char *cell = row < 0 ? sheet->columns[c] : sheet->cells[row][c];
        snprintf(text + strlen(text), sizeof(text) - strlen(text), "%s%s", c ? "|" : "", cell);
    }
    assert_string_equal(text, due);
}

static void expect_sheet(const struct rig *rig, int work, int variant, const char *const *lines)
{
    struct rg_sheet sheet = made(rig, work, variant);
    int rows = -1;
    for (; lines[rows + 1]; rows++)
        expect_line(&sheet, rows, lines[rows + 1]);
    assert_int_equal(sheet.row_count, rows);
    rg_sheet_free(&sheet);
}
#define EXPECT_SHEET(rig, work, variant, ...)                                                      \
    expect_sheet(rig, work, variant, (const char *const[]){__VA_ARGS__, NULL})

// --- print ---

static const struct rg_table texture_table = {
    .id = "textures",
    .technique = "flow",
    .hardware = "paper",
    .names = "atlas",
    .columns = {"level", "width_px", "height_px"},
    .key_count = 1,
    .variants = {{"full", "", NULL}},
    .is_of_textures = true,
    .row_count = 2,
    .rows = (const struct rg_table_row[]){{"", {0, 32, 3606}, "environment"},
                                          {"", {1, 16, 1803}, "environment"}},
    .note = "a note",
};

static void sizes_of_textures_are_beside_print(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &texture_table, (double[]){1, 0});
    sheet_tell(sheet_record_at(&rig, 0, 0), "width_px", 32);
    sheet_tell(sheet_record_at(&rig, 0, 0), "height_px", 3607);
    EXPECT_SHEET(&rig, 0, 0, "atlas|level|print|cpu", "environment|0|32x3606|32x3607",
                 "environment|1|16x1803|fail");
    rg_result_free(&rig.result);
    sheet_measure_on(&rig, &texture_table, (double[]){1, 1, 0, 1}, 2); // each device has its own
    for (int i = 0; i < 3; i++) {
        const struct rg_place place = {.row = i / 2, .device = i ? 1 : 0};
        sheet_tell(rg_result_at(&rig.result, place), "width_px", 32 + i);
        sheet_tell(rg_result_at(&rig.result, place), "height_px", 3606);
    }
    EXPECT_SHEET(&rig, 0, 0, "atlas|level|print|cpu|reference",
                 "environment|0|32x3606|32x3606|33x3606", "environment|1|16x1803|fail|34x3606");
    rg_result_free(&rig.result);
}

static const struct rg_table range = {
    .id = "range",
    .technique = "drops",
    .hardware = "paper",
    .columns = {"columns", "merge", "ms_per_frame_min", "ms_per_frame_max"},
    .key_count = 2,
    .has_choices = true,
    .variants = {{"full", "", NULL}},
    .works = {{"paper", "sleep=off", ""}, {"ours", "sleep=on", "less"}},
    .row_count = 1,
    .rows = (const struct rg_table_row[]){{"", {1000, 1, 10, 25}, NULL}},
    .note = "a note",
};

// A paper that prints two times has a range, and its middle is what others are a multiple of.
static void ranges_of_print_have_a_middle(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &range, (double[]){200, 500}); // print: 100 to 40
    EXPECT_SHEET(&rig, 0, 0, "columns|print|cpu", "1000|40.0-100|200  3.2x");
    EXPECT_SHEET(&rig, 1, 0, "columns|print|cpu", "1000|40.0-100|500  2.5x");
    // The printed work has no number.
    sheet_record_at(&rig, 0, 0)->outcome = RG_TIMEOUT;
    EXPECT_SHEET(&rig, 0, 0, "columns|print|cpu", "1000|40.0-100|timeout");
    EXPECT_SHEET(&rig, 1, 0, "columns|print|cpu", "1000|40.0-100|500");
    rg_result_free(&rig.result);
}

// Each variant has its own print.
static void variants_have_their_own_print(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_styles_table, (double[]){50, 100, 60, 110, 45, 50, 60, 110});
    EXPECT_SHEET(&rig, 0, 0, "scene|print|cpu", "mirror|100|50.0 0.50x", "dragon|80.0|45.0 0.56x");
    EXPECT_SHEET(&rig, 0, 1, "scene|print|cpu", "mirror|200|100 0.50x", "dragon|190|50.0 0.26x");
    EXPECT_SHEET(&rig, 1, 1, "scene|print|cpu", "mirror|200|110  1.1x", "dragon|190|110  2.2x");
    rg_result_free(&rig.result);
}

// --- what tells rows apart ---

static const struct rg_table plain = {
    .id = "plain",
    .technique = "flow",
    .columns = {"camera_mm_s", "lights"},
    .key_count = 2,
    .has_choices = true,
    .variants = {{"full", "", NULL}},
    .row_count = 2,
    .note = "a note",
};

static void columns_are_those_that_differ(void **state)
{
    (void)state;
    static const struct rg_table_row both[] = {{"", {5, 1}, NULL}, {"", {6, 2}, NULL}},
                                     second[] = {{"", {5, 1}, NULL}, {"", {5, 2}, NULL}},
                                     neither[] = {{"", {5, 1}, NULL}, {"", {5, 1}, NULL}};
    struct rg_table table = plain;
    struct rig rig;
    table.rows = both;
    sheet_measure(&rig, &table, (double[]){1, 2});
    EXPECT_SHEET(&rig, 0, 0, "camera, mm/s|lights|cpu", "5|1|1.00", "6|2|2.00");
    rg_result_free(&rig.result);
    table.rows = second;
    sheet_measure(&rig, &table, (double[]){1, 2});
    EXPECT_SHEET(&rig, 0, 0, "lights|cpu", "1|1.00", "2|2.00");
    // A row alone is told by its first value.
    assert_true(rg_result_keep_rows(&rig.result, 1, 1));
    EXPECT_SHEET(&rig, 0, 0, "camera, mm/s|cpu", "5|2.00");
    rg_result_free(&rig.result);
    table.rows = neither;
    sheet_measure(&rig, &table, (double[]){1, 2});
    EXPECT_SHEET(&rig, 0, 0, "row|cpu", "1|1.00", "2|2.00");
    rg_result_free(&rig.result);
}

// Choices of rows with names of their own repeat these; rows of one name are told apart by them.
static void choices_stand_beside_equal_names(void **state)
{
    (void)state;
    static const struct rg_table_row own[] = {{"", {1}, "all"}, {"", {0}, "none"}},
                                     equal[] = {{"", {1}, "city"}, {"", {0}, "city"}};
    struct rg_table table = {.id = "parts",
                             .technique = "drops",
                             .names = "parts",
                             .columns = {"merge"},
                             .key_count = 1,
                             .has_choices = true,
                             .variants = {{"full", "", NULL}},
                             .row_count = 2,
                             .rows = own,
                             .note = "a note"};
    struct rig rig;
    sheet_measure(&rig, &table, (double[]){1, 2});
    EXPECT_SHEET(&rig, 0, 0, "parts|cpu", "all|1.00", "none|2.00");
    rg_result_free(&rig.result);
    table.rows = equal;
    sheet_measure(&rig, &table, (double[]){1, 2});
    EXPECT_SHEET(&rig, 0, 0, "parts|merge|cpu", "city|on|1.00", "city|off|2.00");
    rg_result_free(&rig.result);
}

// A missing row has no line, and the first that is there tells which columns there are.
static void rows_that_are_missing_have_no_line(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){160, 60, 120, 292});
    assert_ptr_equal(rg_beside_first(&rig.result, (struct rg_place){0}),
                     sheet_record_at(&rig, 0, 0));
    rg_result_drop_row(&rig.result, 0);
    rg_result_drop_row(&rig.result, 2);
    assert_ptr_equal(rg_beside_first(&rig.result, (struct rg_place){0}),
                     sheet_record_at(&rig, 1, 0));
    EXPECT_SHEET(&rig, 0, 0, "scene|print|cpu", "dragon|120|60.0 0.50x", "planck|146|292  2.0x");
    rg_result_drop_row(&rig.result, 1);
    rg_result_drop_row(&rig.result, 3);
    assert_null(rg_beside_first(&rig.result, (struct rg_place){0}));
    rg_result_free(&rig.result);
}

// --- columns that tell more ---

// The share of print's particles, the error, and the work of the first device that can count it. A
// few primitives, and what no device can count, have no column.
static void work_and_errors_have_columns(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure_on(&rig, &sheet_axis_table, (double[]){40, 4, 1, 1, 20, 2, 1, 1, 10, 1, 1, 1}, 2);
    for (int row = 0; row < 3; row++)
        for (int d = 0; d < 2; d++) {
            struct rg_record *record =
                rg_result_at(&rig.result, (struct rg_place){.row = row, .device = d});
            record->has_tally = d == 1;
            record->tally = (struct rg_tally){.records = 100 + row, .fragments = 56789};
            record->truth_error.flip_mask_mean = 0.0126 * row;
        }
    sheet_record_at(&rig, 2, 0)->truth_error.outcome = RG_FAIL;
    sheet_tell(sheet_record_at(&rig, 0, 0), "particles", 70303 * 1.1);
    EXPECT_SHEET(&rig, 0, 0, "radius, m|print|drawn|error|packed, k|shaded, k|cpu|reference",
                 "5|400|1.10|0.000|0.10|56.8|40.0 0.10x|4.00 0.01x",
                 "10|200||0.013|0.10|56.8|20.0 0.10x|2.00 0.01x",
                 "20|100|||0.10|56.8|10.0 0.10x|1.00 0.01x");
    struct rg_record *counting = rg_result_at(&rig.result, (struct rg_place){.device = 1});
    counting->tally.records = 99;
    counting->tally.fragments = -1;
    struct rg_sheet sheet = made(&rig, 0, 0);
    expect_line(&sheet, -1, "radius, m|print|drawn|error|cpu|reference");
    rg_sheet_free(&sheet);
    rg_result_free(&rig.result);
}

#define ALL    "radius, m|print|drawn|error|cpu|reference|gl"
#define DRAWN  "radius, m|print|drawn|cpu|reference|gl"
#define BARE   "radius, m|print|cpu|reference|gl"
#define NO_REF "radius, m|print|cpu|gl"
static const struct {
    int width, optional;
    enum rg_beside_marks marks;
    bool lacks_reference, lacks_times;
    const char *headings;
} widths[] = {{113, 4, RG_BESIDE_INTERVALS, false, false, ALL},
              {112, 4, RG_BESIDE_TEXTS, false, false, ALL},
              {110, 4, RG_BESIDE_TEXTS, false, false, ALL},
              {93, 4, RG_BESIDE_TEXTS, false, false, ALL},
              {92, 1, RG_BESIDE_TEXTS, false, false, DRAWN},
              {84, 0, RG_BESIDE_TEXTS, false, false, BARE},
              {76, 1, RG_BESIDE_LETTERS, false, false, DRAWN},
              {62, 0, RG_BESIDE_LETTERS, false, false, BARE},
              {61, 0, RG_BESIDE_LETTERS, true, false, NO_REF},
              {47, 0, RG_BESIDE_LETTERS, true, true, NO_REF}};

// A page that lacks room leaves out intervals, then columns from the last, with shorter marks the
// same again, then cpu:reference, and then how many times print it is. Cells of cpu have 23 letters
// with intervals, 16 with texts and 11 with a letter, gl's one or two less; a column has three
// more.
static void narrow_pages_have_less(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure_on(&rig, &sheet_axis_table,
                     (double[]){40, 4, 400, 1, 1, 1, 20, 2, 200, 1, 1, 1, 10, 1, 100, 1, 1, 1}, 3);
    for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);) {
        struct rg_record *record = rg_result_at(&rig.result, at);
        record->frame_ms.low = record->frame_ms.median / 1.25;
        record->frame_ms.high = record->frame_ms.median * 1.25;
        sheet_tell(record, "particles",
                   *rg_named_number(record->published, record->published_count, "particles"));
    }
    for (size_t i = 0; i < sizeof(widths) / sizeof(widths[0]); i++) {
        struct rg_sheet sheet;
        const struct rg_beside_layout layout =
            rg_beside_fit(&rig.result, (struct rg_place){0}, widths[i].width, &sheet);
        expect_line(&sheet, -1, widths[i].headings);
        assert_int_equal(layout.optional, widths[i].optional);
        assert_int_equal(layout.marks, widths[i].marks);
        assert_int_equal(layout.lacks_reference, widths[i].lacks_reference);
        assert_int_equal(layout.lacks_times, widths[i].lacks_times);
        rg_sheet_free(&sheet);
    }
    rg_result_free(&rig.result);
}

// A cell that others disturbed says so with each kind of mark; its neighbour says nothing.
static void disturbed_cells_are_marked(void **state)
{
    (void)state;
    static const char *const due[] = {
        [RG_BESIDE_INTERVALS] = "5|400|40.0 [32.0, 50.0] busy 0.10x|4.00 [3.20, 5.00] 0.01x",
        [RG_BESIDE_TEXTS] = "5|400|40.0 +-25% busy 0.10x|4.00 +-25% 0.01x",
        [RG_BESIDE_LETTERS] = "5|400|40.0! 0.10x|4.00~ 0.01x",
    };
    struct rig rig;
    sheet_measure_on(&rig, &sheet_axis_table, (double[]){40, 4, 1, 1, 20, 2, 1, 1, 10, 1, 1, 1}, 2);
    for (struct rg_place at = rg_result_start(&rig.result); rg_result_next(&rig.result, &at);) {
        struct rg_record *record = rg_result_at(&rig.result, at);
        record->frame_ms.low = record->frame_ms.median / 1.25;
        record->frame_ms.high = record->frame_ms.median * 1.25;
        record->taken[0] = at.device == 0 ? 2 * RG_MOST_TAKEN : 0;
    }
    for (int marks = 0; marks < (int)(sizeof(due) / sizeof(due[0])); marks++) {
        const struct rg_beside_layout layout = {0, (enum rg_beside_marks)marks, false, false};
        struct rg_sheet sheet;
        rg_beside_make(&rig.result, (struct rg_place){0}, &layout, &sheet);
        expect_line(&sheet, 0, due[marks]);
        rg_sheet_free(&sheet);
    }
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_of_textures_are_beside_print),
        cmocka_unit_test(ranges_of_print_have_a_middle),
        cmocka_unit_test(variants_have_their_own_print),
        cmocka_unit_test(columns_are_those_that_differ),
        cmocka_unit_test(choices_stand_beside_equal_names),
        cmocka_unit_test(rows_that_are_missing_have_no_line),
        cmocka_unit_test(work_and_errors_have_columns),
        cmocka_unit_test(narrow_pages_have_less),
        cmocka_unit_test(disturbed_cells_are_marked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
