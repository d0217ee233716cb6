// The rows that a journal holds of results that no device made, and the folder of a journal.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/record/disk/journal.h"
#include "harness/record/disk/stored.h"
#include "tests/harness/record/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

static int setup(void **state)
{
    rg_log_listen(log_last, NULL);
    logged_lines = 0;
    return make_folder(state);
}

static int teardown(void **state)
{
    rg_log_listen(NULL, NULL);
    return remove_whole_folder(state);
}

// Rows 1 to 3, counted from 0, of devices with limits, all without errors.
static struct rg_result make_rows(void)
{
    struct rg_result result = make_result();
    assert_true(rg_result_add_row(&result, 2));
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);) {
        struct rg_record *record = rg_result_at(&result, at);
        const struct rg_place well = {at.row == 2 ? 1 : at.row, at.work, at.variant, 0};
        *record = *rg_result_at(&result, well);
        record->device = result.devices[at.device];
        record->device.limits.max_objects = 7;
    }
    return result;
}

// The rows that a journal has, a bit each.
static int rows_of(const struct rg_journal *journal)
{
    int rows = 0;
    for (int row = 1; row <= 3; row++)
        rows |= rg_journal_has(journal, row) << row;
    return rows;
}

static void test_rows(void **state)
{
    (void)state;
    struct rg_result result = make_rows();
    struct rg_journal *journal = rg_journal_open(&result, folder, false, true);
    rg_journal_add(journal, &result, 1, 2);
    assert_int_equal(rows_of(journal), 2 | 4);
    rg_journal_add(journal, &result, 3, 3);
    assert_int_equal(rows_of(journal), 2 | 4 | 8);
    rg_journal_close(journal);
    struct rg_result again = make_rows();
    journal = rg_journal_open(&again, folder, false, true);
    assert_int_equal(rows_of(journal), 2 | 4 | 8);
    assert_true(rg_journal_take(journal, &again, 1));
    const struct rg_place first = {.row = 1};
    assert_int_equal(rg_result_at(&again, first)->device.limits.max_objects, 7);
    rg_journal_close(journal);
    rg_result_free(&result);
    rg_result_free(&again);
}

// After a driver's error in one cell, or in its truth's, the row is measured again.
static void test_errors(void **state)
{
    (void)state;
    static const enum rg_outcome broken[] = {RG_ERROR, RG_CRASH, RG_TIMEOUT};
    for (int i = 0; i < 6; i++) {
        struct rg_result result = make_rows();
        const struct rg_place at = {.row = 2, .variant = 1, .device = 1};
        struct rg_record *record = rg_result_at(&result, at);
        *(i % 2 ? &record->truth_error.outcome : &record->outcome) = broken[i / 2];
        struct rg_journal *journal = rg_journal_open(&result, folder, true, true);
        rg_journal_add(journal, &result, 1, 3);
        assert_int_equal(rows_of(journal), 2 | 8);
        rg_journal_close(journal);
        rg_result_free(&result);
    }
}

// --- the journal's folder ---

// The path of a journal without a given folder, after the test's folder; "" if there is none.
static const char *place_with(const char *state_home, const char *home)
{
    static char path[2048];
    struct rg_result result = make_rows();
    state_home ? setenv("XDG_STATE_HOME", state_home, 1) : unsetenv("XDG_STATE_HOME");
    setenv("HOME", home, 1);
    struct rg_journal *journal = rg_journal_open(&result, NULL, true, true);
    rg_journal_add(journal, &result, 1, 1);
    const char *found = rg_journal_path(journal);
    snprintf(path, sizeof(path), "%s", found ? found : "");
    rg_journal_close(journal);
    rg_result_free(&result);
    return path + (strncmp(path, folder, strlen(folder)) ? 0 : strlen(folder));
}

static void test_places(void **state)
{
    (void)state;
    char home[128], long_home[4096];
    snprintf(home, sizeof(home), "%s/theirs", folder);
    assert_int_equal(strncmp(place_with(NULL, home), "/theirs/.local/state/raingauge/", 31), 0);
    assert_int_equal(strncmp(place_with(folder, home), "/raingauge/", 11), 0);
    assert_int_equal(strncmp(place_with("relative", home), "/theirs/.local/state/", 21), 0);
    assert_int_equal(logged_lines, 0);
    assert_string_equal(place_with(NULL, "relative"), "");
    assert_int_equal(logged_lines, 1);
    // A path that is too long gives no journal, and no shortened path.
    snprintf(long_home, sizeof(long_home), "%s/", folder);
    for (size_t used = strlen(long_home); used < 1530; used += 2)
        strcpy(long_home + used, "a/");
    assert_string_equal(place_with(NULL, long_home), "");
    assert_int_equal(logged_lines, 2);
}

// --- folders of results ---

static void write_result(const char *name, const char *text)
{
    char path[128];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

// A folder gives its files that end in .json and .journal; a file gives each of its documents.
static void test_folder(void **state)
{
    (void)state;
    struct rg_result made = make_result();
    json_t *document = rg_result_json(&made);
    char *text = json_dumps(document, 0), twice[1 << 20], path[128];
    assert_below(strlen(text), sizeof(twice) / 2 - 8);
    snprintf(twice, sizeof(twice), "\n%s\n\n%s\n \n", text, text);
    write_result("a.json", twice);
    write_result("b.journal", text);
    write_result("c.txt", "no result");
    struct rg_stored stored = {0};
    assert_true(rg_stored_read(&stored, folder));
    assert_int_equal(stored.count, 3);
    rg_stored_free(&stored);
    // A link to a folder is as good as the folder.
    snprintf(path, sizeof(path), "%s-link", folder);
    assert_int_equal(symlink(folder, path), 0);
    const bool is_read = rg_stored_read(&stored, path);
    unlink(path);
    assert_true(is_read);
    assert_int_equal(stored.count, 3);
    rg_stored_free(&stored);
    assert_int_equal(logged_lines, 0);
    // An error's line is counted from the file's beginning.
    char why[RG_WHY_SIZE];
    struct rg_result found = {0};
    write_result("a.json", "\n\n{\"format\":\n 1,\n x}");
    snprintf(path, sizeof(path), "%s/a.json", folder);
    assert_false(rg_stored_read_one(path, &found, why));
    assert_non_null(strstr(why, "line 5 is no JSON"));
    snprintf(twice, sizeof(twice), "%s\n\n{\"format\":\n 1,\n x}", text);
    write_result("a.json", twice);
    assert_false(rg_stored_read(&stored, path));
    assert_non_null(strstr(rg_last_error(), "line 5 is no JSON"));
    rg_stored_free(&stored);
    free(text);
    json_decref(document);
    rg_result_free(&made);
}

// Writes a result of a table of this name into a folder of the test's.
static void write_table(const char *inner, const char *table)
{
    char name[48], path[128];
    struct rg_result made = make_result();
    snprintf(made.table, sizeof(made.table), "%s", table);
    json_t *document = rg_result_json(&made);
    char *text = json_dumps(document, 0);
    snprintf(path, sizeof(path), "%s/%s", folder, inner);
    mkdir(path, 0777);
    snprintf(name, sizeof(name), "%s/%s.json", inner, table);
    write_result(name, text);
    free(text);
    json_decref(document);
    rg_result_free(&made);
}

// The files of a folder come by name, and then those of the folders that a comparison key names.
static void test_machines(void **state)
{
    (void)state;
    static const char *const inner[] = {
        ".",    "0123456789abcdef", "aaaaaaaaaaaaaaaa", "0123456789abcdeF", "0123456789abcde",
        "other"};
    static const char *const order[] = {"t0", "u0", "t1", "u1", "t2", "u2"};
    struct rg_stored stored = {0};
    for (int i = 0; i < 6; i++) {
        char table[16];
        snprintf(table, sizeof(table), "u%d", i);
        write_table(inner[i], table);
        *table = 't';
        write_table(inner[i], table);
    }
    write_result("bbbbbbbbbbbbbbbb", "a file of such a name");
    assert_true(rg_stored_read(&stored, folder));
    assert_int_equal(stored.count, 6);
    for (int i = 0; i < 6; i++)
        assert_string_equal(stored.results[i].table, order[i]);
    rg_stored_free(&stored);
    assert_true(!stored.count && !stored.results);
    assert_int_equal(logged_lines, 0);
}

// A folder without results, and one that is not there, are errors.
static void test_no_results(void **state)
{
    (void)state;
    char path[128];
    struct rg_stored stored = {0};
    write_result("a.txt", "no result");
    write_result(".json", "no name");
    assert_false(rg_stored_read(&stored, folder));
    assert_non_null(strstr(rg_last_error(), ": holds no .json and no .journal; name a folder"));
    snprintf(path, sizeof(path), "%s/none", folder);
    assert_false(rg_stored_read(&stored, path));
    assert_non_null(strstr(rg_last_error(), "/none: cannot be read: No such file or directory; "));
    assert_int_equal(logged_lines, 2);
    rg_stored_free(&stored);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(test_rows),   TEST(test_errors),   TEST(test_places),
        TEST(test_folder), TEST(test_machines), TEST(test_no_results),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
