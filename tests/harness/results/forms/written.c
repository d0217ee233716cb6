// Files of a table: when they are written, what they must not replace, and how a command ends.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/tables/print.h"
#include "tests/harness/results/forms/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

static int begin(void **state)
{
    *logged = 0;
    rg_log_listen(log_last, NULL);
    return make_folder(state);
}

static int end(void **state)
{
    rg_log_listen(NULL, NULL);
    remove_whole_folder(state);
    return 0;
}

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static bool holds(const char *name, const char *text)
{
    char found[16] = "";
    FILE *file = fopen(in_folder(name), "r");
    assert_non_null(file);
    found[fread(found, 1, sizeof(found) - 1, file)] = 0;
    fclose(file);
    return !strcmp(found, text);
}

// --- how a table ends ---

// By the outcomes of its cells; an image that could not be compared with the truth is a failure,
// and one that shows no rain is told by its cell.
static void a_table_ends_as_its_cells(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome cell, truth;
        int exit;
    } cases[] = {{RG_OK, RG_OK, RG_EXIT_PASS},
                 {RG_FAIL, RG_OK, RG_EXIT_FAIL},
                 {RG_CRASH, RG_OK, RG_EXIT_FAIL},
                 {RG_UNSUPPORTED, RG_OK, RG_EXIT_PASS},
                 {RG_NOTHING, RG_OK, RG_EXIT_NOTHING},
                 {RG_LACKING, RG_OK, RG_EXIT_HARNESS},
                 {RG_OK, RG_ERROR, RG_EXIT_FAIL},
                 {RG_OK, RG_LACKING, RG_EXIT_HARNESS},
                 {RG_OK, RG_UNSUPPORTED, RG_EXIT_PASS},
                 {RG_OK, RG_NOTHING, RG_EXIT_PASS},
                 {RG_UNSUPPORTED, RG_CRASH, RG_EXIT_FAIL}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rig rig;
        sheet_measure(&rig, &sheet_names_table, (double[]){40, 30, 20, 10});
        struct rg_record *record = sheet_record_at(&rig, 2, 0);
        record->outcome = cases[i].cell;
        record->truth_error.outcome = cases[i].truth;
        assert_int_equal(rg_result_exit(&rig.result), cases[i].exit);
        rg_result_free(&rig.result);
    }
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){40, 30, 20, 10});
    for (int row = 0; row < 4; row++)
        sheet_record_at(&rig, row, 0)->outcome = RG_UNSUPPORTED;
    assert_int_equal(rg_result_exit(&rig.result), RG_EXIT_UNSUPPORTED);
    rg_result_free(&rig.result);
}

// --- forms ---

static void each_form_is_its_own(void **state)
{
    (void)state;
    static const struct {
        int format;
        const char *begin, *has, *lacks; // `lacks`: a column that only wide forms have
    } forms[] = {{RG_RESULT_MD, "## names\n", "| ", "ms, 95 %"},
                 {RG_RESULT_WIDE, "## names\n", "ms, 95 %", "\\"},
                 {RG_RESULT_CSV, "scene,", "ms, 95 %", "|"},
                 {RG_RESULT_JSON, "{\n", "\"cells\"", "ms, 95 %"},
                 {RG_RESULT_TEX, "\\begin{table}", "\\\\", "ms, 95 %"}};
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){40, 30, 20, 10});
    for (size_t i = 0; i < sizeof(forms) / sizeof(forms[0]); i++) {
        static char text[1 << 16];
        memset(text, 0, sizeof(text));
        FILE *out = fmemopen(text, sizeof(text), "w");
        assert_non_null(out);
        assert_true(rg_result_print(&rig.result, forms[i].format, out));
        assert_int_equal(fclose(out), 0);
        if (strncmp(text, forms[i].begin, strlen(forms[i].begin)) != 0 ||
            !strstr(text, forms[i].has) || strstr(text, forms[i].lacks))
            fail_msg("form %d is not its own: %.600s", (int)i, text);
    }
    rg_result_free(&rig.result);
}

// --- earlier files ---

// A result without a number replaces none that is there; it is written where there is none.
static void files_stay_where_nothing_was_measured(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){0, 0, 0, 0});
    write_text("names.json", "earlier");
    write_text("names.md", "as well");
    assert_true(rg_result_write(&rig.result, folder));
    assert_true(holds("names.json", "earlier") && holds("names.md", "as well"));
    char due[512];
    snprintf(due, sizeof(due), "%s: is kept, for no cell of names was measured now",
             in_folder("names.json"));
    assert_string_equal(logged, due);
    assert_int_equal(unlink(in_folder("names.json")), 0);
    assert_true(rg_result_write(&rig.result, folder));
    assert_false(holds("names.json", "earlier") || holds("names.md", "as well"));
    rg_result_free(&rig.result);
    // One number is enough.
    sheet_measure(&rig, &sheet_names_table, (double[]){0, 0, 0, 10});
    write_text("names.json", "earlier");
    assert_true(rg_result_write(&rig.result, folder));
    assert_false(holds("names.json", "earlier"));
    for (int i = 0; rg_result_formats[i]; i++) {
        char name[32];
        snprintf(name, sizeof(name), "names.%s", rg_result_formats[i]);
        assert_int_equal(unlink(in_folder(name)), 0);
    }
    assert_int_equal(rmdir(folder), 0); // no other file
    rg_result_free(&rig.result);
}

// Each file that a table leaves, its journals included, could replace what is read.
static void files_that_are_read_are_spared(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        bool is_spared;
    } cases[] = {{"names.md", false},
                 {"names.csv", false},
                 {"names.json", false},
                 {"names.tex", false},
                 {"names-quick.journal", false},
                 {"names-full.journal", false},
                 {"names.txt", true},
                 {"name.json", true},
                 {"other.json", true}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        write_text(cases[i].name, "read");
        *logged = 0;
        assert_int_equal(rg_result_spares(&sheet_names_table, folder, in_folder(cases[i].name)),
                         cases[i].is_spared);
        assert_int_equal(!*logged, cases[i].is_spared);
        assert_int_equal(unlink(in_folder(cases[i].name)), 0);
    }
}

// All files of all tables are tried before any is measured: a folder in the place of one is
// noticed.
static void files_that_cannot_be_written_are_told(void **state)
{
    (void)state;
    static const struct rg_table *const tables[] = {&sheet_names_table, &sheet_axis_table};
    static const char *const names[] = {"names.md", "names.tex", "axis.csv", "axis.tex"};
    assert_true(rg_results_can_be_written(tables, 2, folder));
    for (size_t i = 0; i < sizeof(names) / sizeof(names[0]); i++) {
        assert_int_equal(mkdir(in_folder(names[i]), 0777), 0);
        assert_false(rg_results_can_be_written(tables, 2, folder));
        assert_non_null(strstr(logged, names[i]));
        assert_true(rg_results_can_be_written(&tables[1], i < 2, folder));
        assert_int_equal(rmdir(in_folder(names[i])), 0);
    }
}

// --- the end of a command ---

// A table whose files are lost is printed all the same, and the command fails.
static void a_table_whose_files_are_lost(void **state)
{
    (void)state;
    struct rig rig;
    sheet_measure(&rig, &sheet_names_table, (double[]){40, 30, 20, 10});
    assert_int_equal(rg_result_finish(&rig.result, RG_RESULT_CSV, folder), RG_EXIT_PASS);
    assert_false(holds("names.csv", ""));
    assert_int_equal(rg_result_finish(&rig.result, RG_RESULT_CSV, NULL), RG_EXIT_PASS);
    assert_int_equal(rg_result_finish(&rig.result, RG_RESULT_CSV, in_folder("none/of/these")),
                     RG_EXIT_USAGE);
    sheet_record_at(&rig, 1, 0)->outcome = RG_FAIL;
    assert_int_equal(rg_result_finish(&rig.result, RG_RESULT_CSV, folder), RG_EXIT_FAIL);
    rg_result_free(&rig.result);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_table_ends_as_its_cells, begin, end),
        cmocka_unit_test(each_form_is_its_own),
        cmocka_unit_test_setup_teardown(files_stay_where_nothing_was_measured, begin, end),
        cmocka_unit_test_setup_teardown(files_that_are_read_are_spared, begin, end),
        cmocka_unit_test_setup_teardown(files_that_cannot_be_written_are_told, begin, end),
        cmocka_unit_test_setup_teardown(a_table_whose_files_are_lost, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
