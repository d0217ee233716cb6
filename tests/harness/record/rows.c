// Rows and cells of a result in memory, and files as they are written.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/record/output.h"
#include "harness/tables/print.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

// Rows 1 to 3, counted from 0; row 2 is missing. Their settings are "a=ROW b=2".
static void test_kept_rows(void **state)
{
    (void)state;
    static const struct {
        int first, last, found_first, found_last;
        const char *set;
    } cases[] = {{1, 3, 1, 3, "a=1 b=2"}, {0, 9, 1, 3, "a=1 b=2"}, {1, 1, 1, 1, "a=1 b=2"},
                 {3, 3, 3, 3, "a=3 b=2"}, {2, 9, 2, 3, NULL},      {0, 2, 1, 2, "a=1 b=2"}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_result result = make_result();
        assert_true(rg_result_keep_rows(&result, cases[i].first, cases[i].last));
        assert_int_equal(result.first_row, cases[i].found_first);
        assert_int_equal(result.last_row, cases[i].found_last);
        for (int row = result.first_row; row <= result.last_row; row++)
            assert_int_equal(rg_result_has(&result, row), row != 2);
        if (cases[i].set) {
            const struct rg_place at = {.row = result.first_row};
            assert_string_equal(rg_result_at(&result, at)->set, cases[i].set);
        }
        rg_result_free(&result);
    }
    struct rg_result result = make_result();
    assert_false(rg_result_keep_rows(&result, 4, 9));
    assert_false(rg_result_keep_rows(&result, 0, 0));
    assert_int_equal(rg_result_first_missing(&result), 2);
    rg_result_free(&result);
}

// A table that lacks a row, its last one too, leaves no file.
static void test_whole(void **state)
{
    for (int last = 1; last <= 3; last++) {
        char path[128];
        struct rg_result result = make_result();
        result.last_row = last; // row 2 is missing
        assert_int_equal(make_folder(state), 0);
        rg_result_finish(&result, RG_RESULT_CSV, folder);
        for (int i = 0; rg_result_formats[i]; i++) {
            snprintf(path, sizeof(path), "%s/%s.%s", folder, result.table, rg_result_formats[i]);
            assert_int_equal(!unlink(path), last < 2);
        }
        assert_int_equal(remove_folder(state), 0);
        rg_result_free(&result);
    }
}

// Every cell is another one, and is met once.
static void test_cells(void **state)
{
    (void)state;
    struct rg_result result = make_result();
    int cells = 0;
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        rg_result_at(&result, at)->frames_a_sample = 1000 + cells++;
    assert_int_equal(cells, 2 * 2 * 2 * 2);
    cells = 0;
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        assert_int_equal(rg_result_at(&result, at)->frames_a_sample, 1000 + cells++);
    rg_result_free(&result);
}

// Only measured cells count, wherever they stand.
static void test_samples(void **state)
{
    (void)state;
    static const int counts[] = {5, 9, 3, 7};
    struct rg_result result = make_result();
    char text[64];
    int cell = 0;
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at); cell++) {
        struct rg_record *record = rg_result_at(&result, at);
        record->outcome = cell < 4 ? RG_OK : RG_FAIL;
        record->sample_count = cell < 4 ? counts[cell] : cell % 2 ? 200 : 1;
    }
    rg_result_medians_of(&result, text, sizeof(text));
    assert_string_equal(text, "3 to 9 samples");
    cell = 0;
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at) && cell < 2;) {
        struct rg_record *record = rg_result_at(&result, at);
        record->launch_count = 2 + 2 * cell++;
        for (int i = 0; i < record->launch_count; i++)
            record->launches[i] = (struct rg_launch){.number = i + 1, .ms = 1};
    }
    rg_result_medians_of(&result, text, sizeof(text));
    assert_string_equal(text, "2 to 4 launches or 3 to 7 samples");
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        rg_result_at(&result, at)->sample_count = rg_result_at(&result, at)->launch_count = 0;
    rg_result_medians_of(&result, text, sizeof(text));
    assert_string_equal(text, "0 samples");
    rg_result_free(&result);
}

// --- cells that are counted, chosen and copied ---

// Where a cell of the made result lies: a number of its own.
static int number_of(struct rg_place at)
{
    return 1000 * at.row + 100 * at.work + 10 * at.variant + at.device;
}

static struct rg_result make_numbered(void)
{
    struct rg_result result = make_result();
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        rg_result_at(&result, at)->frames_a_sample = number_of(at);
    return result;
}

// The numbers of its cells, in the order of visiting them.
static const char *numbers_in(const struct rg_result *result)
{
    static char text[256];
    size_t used = 0;
    *text = 0;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        used += (size_t)snprintf(text + used, sizeof(text) - used, " %d",
                                 rg_result_at(result, at)->frames_a_sample);
    return text;
}

// Of rows 1 and 3, two works and two variants on two devices.
static void test_chosen(void **state)
{
    (void)state;
    struct rg_result result = make_numbered();
    assert_string_equal(numbers_in(&result), " 1000 1001 1010 1011 1100 1101 1110 1111 3000 3001 "
                                             "3010 3011 3100 3101 3110 3111");
    assert_int_equal(rg_result_row_cells(&result), 8);
    assert_false(rg_result_keep_work(&result, "queries"));
    assert_true(rg_result_keep_variant(&result, "bare"));
    assert_string_equal(numbers_in(&result), " 1010 1011 1110 1111 3010 3011 3110 3111");
    assert_true(rg_result_keep_work(&result, "ours"));
    assert_string_equal(numbers_in(&result), " 1110 1111 3110 3111");
    assert_string_equal(result.works[0].name, "ours");
    assert_string_equal(result.works[0].saves, "less");
    rg_result_free(&result);
}

// The second result has variants and devices in another order, and one of the works.
static void test_taken(void **state)
{
    (void)state;
    struct rg_result from = make_numbered(), into = make_result();
    memcpy(into.works[0].name, "ours", 5);
    into.work_count = 1;
    memcpy(into.variants[0], "bare", 5);
    memcpy(into.variants[1], "full", 5);
    memcpy(into.devices[0].name, from.devices[1].name, sizeof(into.devices[0].name));
    memcpy(into.devices[1].name, from.devices[0].name, sizeof(into.devices[0].name));
    rg_result_drop_row(&into, 1);
    assert_true(rg_result_add_row(&into, 2)); // which `from` lacks
    rg_result_take(&into, &from);
    assert_string_equal(numbers_in(&into), " 0 0 0 0 3111 3110 3101 3100");
    rg_result_free(&from);
    rg_result_free(&into);
}

// A row with a cell that lacks samples goes; one that ended in another way is whole.
static void test_begun(void **state)
{
    (void)state;
    struct rg_result result = make_result();
    const struct rg_place last = {.row = 3, .work = 1, .variant = 1, .device = 0};
    assert_true(rg_result_is_whole(&result, 1) && rg_result_is_whole(&result, 3));
    rg_result_at(&result, last)->wanted_samples = 8; // of which it has 7
    assert_false(rg_result_is_whole(&result, 3));
    rg_result_drop_begun(&result);
    assert_true(rg_result_has(&result, 1) && !rg_result_has(&result, 3));
    assert_false(rg_result_has(&result, 0) || rg_result_has(&result, 4));
    rg_result_free(&result);
}

// The first row that is neither there nor left out.
static void test_missing(void **state)
{
    (void)state;
    struct rg_result result = make_result();
    assert_int_equal(rg_result_first_missing(&result), 2);
    assert_true(rg_result_wants(&result, 2));
    result.left_out[1] = true;
    assert_false(rg_result_wants(&result, 2));
    assert_true(rg_result_wants(&result, 1) && rg_result_wants(&result, 3));
    assert_int_equal(rg_result_first_missing(&result), 4);
    result.last_row = 2;
    assert_false(rg_result_has(&result, 3));
    result.last_row = 3;
    rg_result_drop_row(&result, 1);
    assert_int_equal(rg_result_first_missing(&result), 1);
    rg_result_free(&result);
}

static void test_work_of_print(void **state)
{
    (void)state;
    struct rg_result result = make_result();
    assert_true(rg_result_is_of_print(&result, 0));
    assert_false(rg_result_is_of_print(&result, 1)); // it saves work
    result.size_divisor = 1;
    assert_true(rg_result_is_of_print(&result, 0));
    result.size_divisor = 2;
    assert_false(rg_result_is_of_print(&result, 0));
    result.size_divisor = 0;
    memcpy(result.changed, "drops=1", 8);
    assert_false(rg_result_is_of_print(&result, 0));
    *result.changed = *result.hardware = 0;
    assert_false(rg_result_is_of_print(&result, 0));
    assert_int_equal(rg_result_printed_work(&result), 0);
    memcpy(result.works[0].name, "queries", 8);
    assert_int_equal(rg_result_printed_work(&result), -1);
    memcpy(result.works[1].name, "paper", 6);
    assert_int_equal(rg_result_printed_work(&result), 1);
    result.work_count = 0;
    assert_int_equal(rg_result_printed_work(&result), 0);
    rg_result_free(&result);
}

// The fastest and the slowest time of the load, at either end of any cell that knows both.
static void test_drift(void **state)
{
    (void)state;
    struct rg_result result = make_result();
    int cell = 0;
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at); cell++) {
        struct rg_record *record = rg_result_at(&result, at);
        record->calibration_begin_ms = cell == 5 ? 4 : cell == 9 ? 3 : cell == 2 ? 0 : 3.5;
        record->calibration_end_ms = cell == 5 ? 3.5 : cell == 9 ? 2 : cell == 2 ? 1 : 3.5;
    }
    assert_equals(rg_result_drift(&result), 1); // 4 ms are once more than 2
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        rg_result_at(&result, at)->calibration_begin_ms = 0;
    assert_equals(rg_result_drift(&result), 0);
    rg_result_free(&result);
}

// A new file gets the mode of any other that the user writes, and a replaced one keeps its mode. A
// file is whole or missing.
static void test_files(void **state)
{
    char path[128], text[16] = "";
    struct stat found;
    assert_int_equal(make_folder(state), 0);
    const mode_t masks[] = {022, 077, 0};
    for (int i = 0; i < 3; i++) {
        const mode_t mask = umask(masks[i]);
        snprintf(path, sizeof(path), "%s/a.txt", folder);
        assert_true(rg_output_write(folder, "a.txt", "first"));
        assert_true(!i || rg_output_write(folder, "a.txt", "again"));
        umask(mask);
        assert_int_equal(stat(path, &found), 0);
        assert_int_equal(found.st_mode & 0777, 0666 & ~masks[i]);
        FILE *file = fopen(path, "r");
        assert_non_null(fgets(text, sizeof(text), file));
        fclose(file);
        assert_string_equal(text, i ? "again" : "first");
        assert_int_equal(unlink(path), 0);
    }
    assert_true(rg_output_write(folder, "a.txt", "first"));
    assert_int_equal(chmod(path, 0600), 0);
    assert_true(rg_output_write(folder, "a.txt", "again"));
    assert_int_equal(stat(path, &found), 0);
    assert_int_equal(found.st_mode & 0777, 0600);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(remove_folder(state), 0); // nothing else is left in it
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kept_rows),     cmocka_unit_test(test_whole),
        cmocka_unit_test(test_cells),         cmocka_unit_test(test_samples),
        cmocka_unit_test(test_chosen),        cmocka_unit_test(test_taken),
        cmocka_unit_test(test_begun),         cmocka_unit_test(test_missing),
        cmocka_unit_test(test_work_of_print), cmocka_unit_test(test_drift),
        cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
