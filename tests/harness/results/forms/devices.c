// Notes of a sheet about several devices, and about how and of what it was measured.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "tests/harness/results/forms/rig.h"
#include "tests/tools/expect.h"

// The number of notes that are this text; whole: or that have it in them.
static int count(const struct rg_sheet *sheet, const char *text, bool is_whole)
{
    int found = 0;
    for (int n = 0; n < sheet->note_count; n++)
        found += is_whole ? !strcmp(sheet->notes[n], text) : strstr(sheet->notes[n], text) != NULL;
    return found;
}

static void expect_note(const struct rg_result *result, const char *text)
{
    struct rg_sheet sheet;
    rg_result_sheet(result, &sheet);
    if (count(&sheet, text, true) != 1) {
        for (int n = 0; n < sheet.note_count; n++)
            print_error("%s\n", sheet.notes[n]);
        fail_msg("%d times: %s", count(&sheet, text, true), text);
    }
    rg_sheet_free(&sheet);
}

// The number of notes with a text.
static int notes_with(const struct rg_result *result, const char *text)
{
    struct rg_sheet sheet;
    rg_result_sheet(result, &sheet);
    const int found = count(&sheet, text, false);
    rg_sheet_free(&sheet);
    return found;
}

static struct rg_record *record_on(const struct rig *rig, int row, int device)
{
    return rg_result_at(&rig->result, (struct rg_place){.row = row, .device = device});
}

// Devices that failed for one reason share a note, which names them in order.
static void test_alike(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure_on(&rig, &sheet_names_table,
                     (double[]){50, 5, 5, 5, 0, 0, 0, 0, 11, 1, 1, 0, 20, 2, 2, 2}, 4);
    snprintf(record_on(&rig, 1, 1)->detail, RG_DETAIL_SIZE, "too slow");
    record_on(&rig, 1, 2)->outcome = RG_UNSUPPORTED;
    expect_note(&rig.result, "dragon on cpu, vulkan: differs");
    expect_note(&rig.result, "dragon on cpu:reference: too slow");
    expect_note(&rig.result, "dragon on gl: differs");
    expect_note(&rig.result, "buddha on vulkan: differs");
    assert_int_equal(notes_with(&rig.result, ": differs"), 3);
    rg_result_free(&rig.result);
}

// An error of a row's image is the same on all devices.
static void test_errors_of_images(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure_on(&rig, &sheet_axis_table, (double[]){40, 4, 80, 8, 20, 2, 40, 4, 10, 1, 40, 4},
                     2);
    for (int d = 0; d < 2; d++)
        record_on(&rig, 1, d)->truth_error =
            (struct rg_truth_error){.outcome = RG_FAIL, .detail = "too much"};
    expect_note(&rig.result, "radius_m 10, camera 1, full: no error: too much");
    assert_int_equal(notes_with(&rig.result, "no error"), 1);
    expect_note(&rig.result, "The error is the image's mean FLIP over the rain mask, 0 to 1, "
                             "against the image with radius_m=0.");
    rg_result_free(&rig.result);
}

// Inputs that a row's devices share are told once, and again in the next row.
static void test_inputs(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure_on(&rig, &sheet_names_table, (double[]){50, 5, 10, 1, 11, 1, 20, 2}, 2);
    for (int row = 0; row < 4; row++)
        for (int d = 0; d < 2; d++)
            sheet_tell(record_on(&rig, row, d), "seed", row == 1 && d ? 8 : 7);
    expect_note(&rig.result, "Inputs of mirror: seed 7.");
    expect_note(&rig.result, "Inputs of dragon: seed 7.");
    expect_note(&rig.result, "Inputs of dragon: seed 8.");
    expect_note(&rig.result, "Inputs of buddha: seed 7.");
    assert_int_equal(notes_with(&rig.result, "Inputs of"), 5);
    // Inputs of a cell without a number do not count.
    record_on(&rig, 1, 1)->outcome = RG_FAIL;
    expect_note(&rig.result, "Inputs of every row: seed 7.");
    assert_int_equal(notes_with(&rig.result, "Inputs of"), 1);
    rg_result_free(&rig.result);
}

// Rows that are missing for one reason share a note.
static void test_missing(void **state)
{
    (void)state;
    static const struct {
        const char *rows; // of each: measured, interrupted, or left out
        double budget_s;
        const char *notes[2];
    } cases[] = {{"m--m", 0, {"Rows 2 to 3 are missing: left out by quick mode."}},
                 {"m--m", 60, {"Rows 2 to 3 are missing: left out by a budget."}},
                 {"mii-",
                  60,
                  {"Rows 2 to 3 are missing: the run was interrupted.",
                   "Row 4 is missing: left out by a budget."}},
                 {"-imm",
                  0,
                  {"Row 1 is missing: left out by quick mode.",
                   "Row 2 is missing: the run was interrupted."}},
                 {"imim",
                  0,
                  {"Row 1 is missing: the run was interrupted.",
                   "Row 3 is missing: the run was interrupted."}}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rig rig;
        sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
        rig.result.budget_s = cases[i].budget_s;
        for (int row = 0; row < 4; row++) {
            rig.result.left_out[row] = cases[i].rows[row] == '-';
            if (cases[i].rows[row] != 'm')
                rg_result_drop_row(&rig.result, row);
        }
        const int due = cases[i].notes[1] ? 2 : 1;
        for (int n = 0; n < due; n++)
            expect_note(&rig.result, cases[i].notes[n]);
        assert_int_equal(notes_with(&rig.result, " missing: "), due);
        rg_result_free(&rig.result);
    }
}

#define CLOCK "Times are wall clock between full syncs, medians of "

static void test_method(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){50, 10, 11, 20});
    expect_note(&rig.result, "Published on paper. " CLOCK "11 samples (quick).");
    sheet_record_at(&rig, 1, 0)->sample_count = 7;
    sheet_record_at(&rig, 2, 0)->sample_count = 9;
    rig.result.full = true;
    expect_note(&rig.result, "Published on paper. " CLOCK "7 to 11 samples (full).");
    *rig.result.hardware = 0;
    expect_note(&rig.result, CLOCK "7 to 11 samples (full).");
    rg_result_free(&rig.result);
}

static void test_works(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_styles_table, (double[]){50, 100, 60, 110, 45, 50, 60, 110});
    snprintf(rig.result.works[0].reading, RG_TITLE_SIZE, "two textures a light");
    snprintf(rig.result.changed, sizeof(rig.result.changed), "seed=2");
    snprintf(rig.result.quick, sizeof(rig.result.quick), "atlas=small");
    expect_note(&rig.result, "Cells of work paper read the paper so: two textures a light.");
    expect_note(&rig.result, "Cells of work ours do less than what was printed: less is drawn.");
    assert_int_equal(notes_with(&rig.result, "Cells of work"), 2);
    expect_note(&rig.result, "All cells have seed=2 over their rows' own settings, so that none "
                             "does what was printed.");
    expect_note(&rig.result,
                "Quick mode sets atlas=small; --full leaves that as the paper has it.");
    expect_note(&rig.result, "a note");
    *rig.result.hardware = 0;
    expect_note(&rig.result, "All cells have seed=2 over their rows' own settings.");
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_alike),  cmocka_unit_test(test_errors_of_images),
        cmocka_unit_test(test_inputs), cmocka_unit_test(test_missing),
        cmocka_unit_test(test_method), cmocka_unit_test(test_works),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
