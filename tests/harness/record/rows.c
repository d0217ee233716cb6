// Rows and cells of a result in memory, and files as they are written.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "harness/record/output.h"
#include "harness/tables/print.h"
#include "tests/harness/record/made.h"

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
    (void)state;
    for (int last = 1; last <= 3; last++) {
        char folder[64] = "/tmp/raingauge-rows-XXXXXX", path[128];
        struct rg_result result = make_result();
        result.last_row = last; // row 2 is missing
        assert_non_null(mkdtemp(folder));
        rg_result_finish(&result, RG_RESULT_CSV, folder);
        for (int i = 0; rg_result_formats[i]; i++) {
            snprintf(path, sizeof(path), "%s/%s.%s", folder, result.table, rg_result_formats[i]);
            assert_int_equal(!unlink(path), last < 2);
        }
        assert_int_equal(rmdir(folder), 0);
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
    int least, most, cell = 0;
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at); cell++) {
        struct rg_record *record = rg_result_at(&result, at);
        record->outcome = cell < 4 ? RG_OK : RG_FAIL;
        record->sample_count = cell < 4 ? counts[cell] : cell % 2 ? 200 : 1;
    }
    rg_result_samples(&result, &least, &most);
    assert_int_equal(least, 3);
    assert_int_equal(most, 9);
    rg_result_free(&result);
}

// A new file gets the mode of any other that the user writes, and a replaced one keeps its mode. A
// file is whole or missing.
static void test_files(void **state)
{
    (void)state;
    char folder[64] = "/tmp/raingauge-rows-XXXXXX", path[128], text[16] = "";
    struct stat found;
    assert_non_null(mkdtemp(folder));
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
    assert_int_equal(rmdir(folder), 0); // nothing else is left in it
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kept_rows), cmocka_unit_test(test_whole),
        cmocka_unit_test(test_cells),     cmocka_unit_test(test_samples),
        cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
