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

#include "core/base/log.h"
#include "harness/record/disk/hold.h"
#include "harness/record/output.h"

static char folder[] = "/tmp/raingauge-output-XXXXXX";
static int messages;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
    messages++;
}

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
    messages = 0;
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
    assert_int_equal(messages, 1);
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
    assert_int_equal(messages, 1);
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

static int make(void **state)
{
    (void)state;
    rg_log_listen(hear, NULL);
    snprintf(folder, sizeof(folder), "/tmp/raingauge-output-XXXXXX");
    return mkdtemp(folder) == NULL;
}

static int clear(void **state)
{
    (void)state;
    static const char *const names[] = {"a.md", "b.csv", "c.json"};
    char path[128];
    for (int i = 0; i < 3; i++) {
        snprintf(path, sizeof(path), "%s/%s", folder, names[i]);
        remove(path);
    }
    rg_log_listen(NULL, NULL);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_set_is_written, make, clear),
        cmocka_unit_test_setup_teardown(what_is_replaced_keeps_its_mode, make, clear),
        cmocka_unit_test_setup_teardown(a_full_disk_changes_none, make, clear),
        cmocka_unit_test_setup_teardown(a_name_that_is_taken_changes_none, make, clear),
        cmocka_unit_test_setup_teardown(a_folder_is_held_by_its_run_alone, make, clear),
    };
    return cmocka_run_group_tests_name("output", tests, NULL, NULL);
}
