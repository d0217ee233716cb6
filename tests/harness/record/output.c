#define _GNU_SOURCE // environ
// Files of results: either all of a set are new, or none.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <xxhash.h>

#include "core/base/log.h"
#include "harness/record/disk/hold.h"
#include "harness/record/output.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

static int files(void)
{
    int count = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *entry; dir && (entry = readdir(dir));)
        count += strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..");
    if (dir)
        closedir(dir);
    return count;
}

static void expect_text(const char *name, const char *text)
{
    char path[128], found[128] = "";
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    found[fread(found, 1, sizeof(found) - 1, file)] = 0;
    fclose(file);
    assert_string_equal(found, text);
}

static bool write_three(const char *third)
{
    const struct rg_output_file set[] = {
        {"a.md", "new a", 0}, {"b.csv", "new b with more", 5}, {"c.json", third, 0}};
    logged_lines = 0;
    return rg_output_write_set(folder, set, 3);
}

static void a_set_is_written(void **state)
{
    (void)state;
    assert_true(rg_output_write(folder, "a.md", "old a"));
    assert_int_equal(files(), 1);
    expect_text("a.md", "old a");
    struct stat st;
    char path[128];
    const mode_t mask = umask(022); // others may read it, like any other file
    umask(mask);
    snprintf(path, sizeof(path), "%s/a.md", folder);
    assert_int_equal(stat(path, &st), 0);
    assert_int_equal(st.st_mode & 0777, 0666 & ~mask);
    assert_true(write_three("new c"));
    assert_int_equal(files(), 3);
    expect_text("a.md", "new a");
    expect_text("b.csv", "new b");
    expect_text("c.json", "new c");
}

// A replaced file keeps its mode, whatever the mask says, so that nobody else can read it.
static void what_is_replaced_keeps_its_mode(void **state)
{
    (void)state;
    static const mode_t modes[] = {0600, 0640, 0666, 0755};
    struct stat st;
    char path[128];
    snprintf(path, sizeof(path), "%s/a.md", folder);
    for (size_t i = 0; i < sizeof(modes) / sizeof(modes[0]); i++) {
        assert_true(rg_output_write(folder, "a.md", "old a"));
        assert_int_equal(chmod(path, modes[i]), 0);
        assert_true(rg_output_write(folder, "a.md", "new a"));
        assert_int_equal(stat(path, &st), 0);
        assert_int_equal(st.st_mode & 07777, modes[i]);
        expect_text("a.md", "new a");
    }
}

// The third file does not fit, so neither the first nor the second changes.
static void a_full_disk_changes_none(void **state)
{
    (void)state;
    static char large[5000];
    struct rlimit before, small;
    memset(large, 'c', sizeof(large) - 1);
    assert_true(rg_output_write(folder, "a.md", "old a"));
    getrlimit(RLIMIT_FSIZE, &before);
    small = before;
    small.rlim_cur = 4096;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    assert_false(write_three(large));
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(logged_lines, 1);
    assert_int_equal(files(), 1);
    expect_text("a.md", "old a");
}

static void a_name_that_is_taken_changes_none(void **state)
{
    (void)state;
    char path[128];
    snprintf(path, sizeof(path), "%s/c.json", folder);
    assert_int_equal(mkdir(path, 0777), 0);
    assert_true(rg_output_write(folder, "a.md", "old a"));
    assert_false(write_three("new c"));
    assert_int_equal(logged_lines, 1);
    assert_int_equal(files(), 2);
    expect_text("a.md", "old a");
}

// Two runs cannot hold a folder at once. A program that a run started and left holds nothing.
static void a_folder_is_held_by_its_run_alone(void **state)
{
    (void)state;
    char *arguments[] = {"sleep", "100", NULL};
    pid_t child;
    struct rg_hold first, second;
    assert_true(rg_hold_folder(folder, &first));
    assert_false(rg_hold_folder(folder, &second));
    assert_int_equal(posix_spawnp(&child, "sleep", NULL, NULL, arguments, environ), 0);
    rg_hold_release(&first);
    const bool is_held = rg_hold_folder(folder, &second);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    assert_true(is_held);
    rg_hold_release(&second);
}

// A path in the test's folder.
static const char *path_of(const char *name)
{
    static char path[256];
    snprintf(path, sizeof(path), "%s%s%s", folder, *name ? "/" : "", name);
    return path;
}

static bool is_there(const char *name)
{
    struct stat st;
    return !lstat(path_of(name), &st);
}

// A run makes a missing folder, and takes it away unless something is in it.
static void a_folder_that_a_run_made_goes_with_it(void **state)
{
    (void)state;
    struct rg_hold hold;
    char made[256];
    snprintf(made, sizeof(made), "%s", path_of("made"));
    assert_true(rg_hold_folder(made, &hold));
    assert_true(is_there("made") && hold.made && hold.fd >= 0);
    rg_hold_release(&hold);
    assert_false(is_there("made") || hold.made || hold.fd >= 0);
    assert_true(rg_hold_folder(made, &hold));
    assert_true(rg_output_write(made, "a.md", "a result"));
    rg_hold_release(&hold);
    assert_true(is_there("made/a.md"));
    assert_int_equal(unlink(path_of("made/a.md")), 0);
    assert_true(rg_hold_folder(made, &hold)); // it was there, and stays
    rg_hold_release(&hold);
    assert_int_equal(rmdir(made), 0);
}

// The user's folder is without a slash, and what it lies in is made.
static void rows_have_a_folder_of_the_users(void **state)
{
    (void)state;
    char found[256], due[256], small[8] = "unset";
    snprintf(due, sizeof(due), "%s", path_of("inner/raingauge"));
    setenv("XDG_STATE_HOME", path_of("inner"), 1);
    rg_state_folder(found, sizeof(found));
    assert_string_equal(found, due);
    assert_true(is_there("inner") && !is_there("inner/raingauge"));
    rg_state_folder(small, sizeof(small));
    assert_string_equal(small, "");
    setenv("XDG_STATE_HOME", "relative", 1);
    setenv("HOME", "relative", 1);
    rg_state_folder(found, sizeof(found));
    assert_string_equal(found, "");
    assert_int_equal(rmdir(path_of("inner")), 0);
}

// A folder that was made for a set goes if the set cannot be written; one that was there stays.
static void a_set_has_its_folder_made(void **state)
{
    (void)state;
    const struct rg_output_file right = {"a.md", "a result", 0};
    const struct rg_output_file set[] = {right, {"none/b.csv", "lies in no folder", 0}};
    char made[256];
    snprintf(made, sizeof(made), "%s", path_of("made"));
    assert_false(rg_output_write_set(made, set, 2));
    assert_false(is_there("made"));
    assert_true(rg_output_folder(made));
    assert_false(rg_output_write_set(made, set, 2));
    assert_true(is_there("made") && !is_there("made/a.md"));
    assert_int_equal(rmdir(made), 0);
    assert_true(rg_output_write_set(made, &right, 1));
    assert_true(is_there("made/a.md"));
    assert_int_equal(unlink(path_of("made/a.md")), 0);
    assert_true(rg_output_folder(made)); // it is there
    assert_int_equal(rmdir(made), 0);
    logged_lines = 0;
    assert_false(rg_output_folder(path_of("none/made")));
    assert_int_equal(logged_lines, 1);
}

static void a_file_is_named_by_its_path(void **state)
{
    (void)state;
    char here[4096], long_path[4096];
    assert_true(rg_output_write_file(path_of("a.md"), "by a path"));
    expect_text("a.md", "by a path");
    assert_non_null(getcwd(here, sizeof(here)));
    assert_int_equal(chdir(folder), 0);
    const bool is_written = rg_output_write_file("b.csv", "here");
    assert_int_equal(chdir(here), 0);
    assert_true(is_written);
    expect_text("b.csv", "here");
    memset(long_path, 'x', sizeof(long_path) - 1);
    long_path[2047] = '/';
    long_path[sizeof(long_path) - 1] = logged_lines = 0;
    assert_false(rg_output_write_file(long_path, "nowhere"));
    assert_int_equal(logged_lines, 1);
}

// Before any work it is found out what cannot be written, and nothing is left behind by that.
static void what_cannot_be_written_is_found_out_before(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int64_t bytes;
        bool is_folder_for, is_file; // a folder for results; a file of them
    } rows[] = {{"", 1, true, false},          {"made", 1, true, true},
                {"made///", 1, true, false},   {"none/made", 1, false, false},
                {"a.md", 1, false, true},      {"a.md/b", 1, false, false},
                {"", INT64_MAX, false, false}, {"made", INT64_MAX, false, false},
                {"fifo", 1, false, false}};
    assert_true(rg_output_write(folder, "a.md", "old a"));
    assert_int_equal(mkfifo(path_of("fifo"), 0600), 0);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        logged_lines = 0;
        if (rg_output_can_be_written(path_of(rows[i].name), rows[i].bytes) != rows[i].is_folder_for)
            fail_msg("folder '%s'", rows[i].name);
        assert_int_equal(logged_lines, !rows[i].is_folder_for);
        logged_lines = 0;
        if (rg_output_file_can_be_written(path_of(rows[i].name), rows[i].bytes) != rows[i].is_file)
            fail_msg("file '%s'", rows[i].name);
        assert_int_equal(logged_lines, !rows[i].is_file);
    }
    assert_int_equal(files(), 2);
    expect_text("a.md", "old a");
    assert_int_equal(unlink(path_of("fifo")), 0);
}

static void what_cannot_be_replaced_is_found_out(void **state)
{
    (void)state;
    char long_name[2100];
    memset(long_name, 'x', sizeof(long_name) - 1);
    long_name[sizeof(long_name) - 1] = logged_lines = 0;
    assert_true(rg_output_write(folder, "a.md", "old a"));
    assert_int_equal(mkdir(path_of("c.json"), 0777), 0);
    assert_true(rg_output_can_be_replaced(folder, "a.md"));
    assert_true(rg_output_can_be_replaced(folder, "b.csv")); // it is not there
    assert_int_equal(logged_lines, 0);
    assert_false(rg_output_can_be_replaced(folder, "c.json"));
    assert_false(rg_output_can_be_replaced(folder, long_name));
    assert_int_equal(logged_lines, 2);
}

// Characters other than letters, digits, '-' and '.' become '_'. A hash follows where others could
// become the same; a device's ':' needs none.
static void names_become_parts_of_files_names(void **state)
{
    (void)state;
    static const struct {
        const char *name, *part;
        bool has_hash;
    } rows[] = {{"cpu", "cpu", false},       {"cpu:reference", "cpu_reference", false},
                {"v1.2-a", "v1.2-a", false}, {"a/b", "a_b", true},
                {"a_b", "a_b", true},        {"$(x) y", "__x__y", true},
                {"\xc3\xa9", "__", true},    {"", "", false}};
    char part[RG_OUTPUT_PART], due[RG_OUTPUT_PART], name[102];
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const size_t length = strlen(rows[i].name);
        rg_output_part(rows[i].name, part);
        snprintf(due, sizeof(due), "%s_%016llx", rows[i].part,
                 (unsigned long long)XXH3_64bits(rows[i].name, length));
        assert_string_equal(part, rows[i].has_hash ? due : rows[i].part);
    }
    memset(name, 'n', sizeof(name));
    name[100] = 0;
    rg_output_part(name, part);
    assert_string_equal(part, name);
    name[100] = 'n';
    name[101] = 0;
    rg_output_part(name, part);
    snprintf(due, sizeof(due), "%.100s_%016llx", name, (unsigned long long)XXH3_64bits(name, 101));
    assert_string_equal(part, due);
}

static int make(void **state)
{
    rg_log_listen(log_last, NULL);
    return make_folder(state);
}

static int clear(void **state)
{
    static const char *const names[] = {"a.md", "b.csv", "c.json"};
    char path[128];
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof(path), "%s/%s", folder, names[i]);
        remove(path);
    }
    rg_log_listen(NULL, NULL);
    return remove_folder(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_set_is_written, make, clear),
        cmocka_unit_test_setup_teardown(what_is_replaced_keeps_its_mode, make, clear),
        cmocka_unit_test_setup_teardown(a_full_disk_changes_none, make, clear),
        cmocka_unit_test_setup_teardown(a_name_that_is_taken_changes_none, make, clear),
        cmocka_unit_test_setup_teardown(a_folder_is_held_by_its_run_alone, make, clear),
        cmocka_unit_test_setup_teardown(a_folder_that_a_run_made_goes_with_it, make, clear),
        cmocka_unit_test_setup_teardown(rows_have_a_folder_of_the_users, make, clear),
        cmocka_unit_test_setup_teardown(a_set_has_its_folder_made, make, clear),
        cmocka_unit_test_setup_teardown(a_file_is_named_by_its_path, make, clear),
        cmocka_unit_test_setup_teardown(what_cannot_be_written_is_found_out_before, make, clear),
        cmocka_unit_test_setup_teardown(what_cannot_be_replaced_is_found_out, make, clear),
        cmocka_unit_test(names_become_parts_of_files_names),
    };
    return cmocka_run_group_tests_name("output", tests, NULL, NULL);
}
