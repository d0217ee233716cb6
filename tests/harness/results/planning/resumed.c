// Tables that are interrupted, or cannot be printed, keep their rows in a journal from which the
// same command goes on. Devices and a technique take time by a script.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/text/add.h"
#include "harness/console/exit.h"
#include "harness/tables/runs/regenerate.h"
#include "tests/harness/results/planning/slow.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

static const struct rg_table_row rows[] = {
    {"", {1}, NULL}, {"", {2}, NULL}, {"", {3}, NULL}, {"", {4}, NULL}};

#define TABLE(its_id)                                                                              \
    {                                                                                              \
        .id = its_id, .technique = "slow", .columns = {"fixed_ms"}, .key_count = 1,                \
        .variants = {{"full", "", NULL}}, .width = 64, .height = 64, .check_frames = 5,            \
        .rows_at_once = 1, .row_count = 4, .rows = rows, .note = "a note"                          \
    }
static const struct rg_table one = TABLE("slow-1"), two = TABLE("slow-2");
static const struct rg_table *const tables[] = {&one, &two};

static char told[2048];
static int resumed_rows, opened; // of the last run

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    rg_text_add(told, sizeof(told), "\n", "%s", line);
}

// The statuses of printing a table, and of what stands below all.
struct printing {
    int table, end;
};

static int print(const struct rg_result *result, const void *user)
{
    resumed_rows += result->resumed_rows;
    return ((const struct printing *)user)->table;
}

static int print_end(const void *user)
{
    return ((const struct printing *)user)->end;
}

static int measure(int count, bool fresh, int interrupted, struct printing printing)
{
    struct slow_rig rig;
    slow_begin(&rig);
    slow_interrupted = interrupted;
    rg_log_listen(hear, NULL);
    const struct rg_regenerate_options options = {.fresh = fresh,
                                                  .folder = folder,
                                                  .print = print,
                                                  .print_end = print_end,
                                                  .user = &printing};
    return rg_tables_regenerate(tables, count, &rig.devices, &options);
}

// Measures so many tables in a process of its own, since one that was interrupted stays so, and
// returns its exit status. Opening number `interrupted` is interrupted; 0: none.
static int run(int count, bool fresh, int interrupted, struct printing printing)
{
    int ends[2], status, numbers[2];
    assert_int_equal(pipe(ends), 0);
    fflush(NULL);
    const pid_t child = fork();
    assert_at_least(child, 0);
    if (child == 0) {
        *told = 0;
        resumed_rows = 0;
        const int exit = measure(count, fresh, interrupted, printing);
        numbers[0] = resumed_rows, numbers[1] = slow_opened;
        const bool ok = write(ends[1], numbers, sizeof(numbers)) == sizeof(numbers) &&
                        write(ends[1], told, sizeof(told)) == sizeof(told);
        _exit(ok ? exit : 99);
    }
    close(ends[1]);
    assert_int_equal(read(ends[0], numbers, sizeof(numbers)), sizeof(numbers));
    assert_int_equal(read(ends[0], told, sizeof(told)), sizeof(told));
    close(ends[0]);
    resumed_rows = numbers[0];
    opened = numbers[1];
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void run_interrupted(int count, int interrupted)
{
    assert_int_equal(run(count, false, interrupted, (struct printing){0}),
                     RG_EXIT_SIGNALLED + SIGINT);
}

// Whether a table's journal is there.
static bool has_journal(const char *table)
{
    char path[128];
    snprintf(path, sizeof(path), "%s/%s-quick.journal", folder, table);
    return access(path, F_OK) == 0;
}

// The openings of all rows of a table.
static int all_opened(void)
{
    static int all;
    if (!all) {
        assert_int_equal(run(1, true, 0, (struct printing){0}), 0);
        assert_string_equal(told, "12 cells measured on 3 devices");
        assert_false(has_journal("slow-1"));
        all = opened;
        assert_true(all > 0 && all % 4 == 0);
    }
    return all;
}

#define BEFORE(rows, parts)                                                                        \
    "slow-1: " rows " of 4 rows are those of a run that was interrupted, and " parts               \
    " have some of their samples; --fresh measures them anew\n"

// Rows are visited in turn. The last visit, of three devices a row, is interrupted in the third
// row.
static void an_interrupted_table_goes_on(void **state)
{
    (void)state;
    char due[256];
    const int all = all_opened();
    run_interrupted(1, all - 2 * 3 + 1);
    snprintf(due, sizeof(due),
             "slow-1: interrupted; the same command goes on with row 3 and what it has of others "
             "(%s/slow-1-quick.journal)",
             folder);
    assert_string_equal(told, due);
    assert_true(has_journal("slow-1"));
    assert_int_equal(run(1, false, 0, (struct printing){0}), 0);
    assert_string_equal(told, BEFORE("2", "2") "12 cells measured on 3 devices");
    assert_int_equal(resumed_rows, 4); // wholly or in part
    assert_below(opened, all / 2);
    assert_false(has_journal("slow-1"));
}

// A table that is done before another is kept with it.
static void tables_before_it_are_kept(void **state)
{
    (void)state;
    const int all = all_opened();
    run_interrupted(2, all + 1);
    assert_ptr_equal(strstr(told, "slow-2: interrupted"), told);
    assert_true(has_journal("slow-1"));
    assert_int_equal(run(2, false, 0, (struct printing){0}), 0);
    assert_string_equal(told, BEFORE("4", "0") "24 cells measured on 3 devices");
    assert_int_equal(resumed_rows, 4);
    assert_false(has_journal("slow-1") || has_journal("slow-2"));
}

// Rows that cannot be written are kept. Rows of a table that fails are not, and a fresh run takes
// none over.
static void what_cannot_be_printed_is_kept(void **state)
{
    (void)state;
    static const struct {
        struct printing printing;
        bool is_kept;
    } cases[] = {{{RG_EXIT_HARNESS, 0}, true}, {{RG_EXIT_USAGE, 0}, true},
                 {{0, RG_EXIT_HARNESS}, true}, {{0, RG_EXIT_USAGE}, true},
                 {{RG_EXIT_FAIL, 0}, false},   {{0, RG_EXIT_FAIL}, false}};
    const int all = all_opened();
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        const int due = cases[i].printing.table + cases[i].printing.end;
        assert_int_equal(run(1, true, 0, cases[i].printing), due);
        assert_string_equal(told, cases[i].is_kept ? "once all can be written, the same command "
                                                     "goes on with what was measured"
                                                   : "12 cells measured on 3 devices");
        assert_int_equal(has_journal("slow-1"), cases[i].is_kept);
        assert_int_equal(run(1, i == 0, 0, (struct printing){0}), 0);
        assert_int_equal(opened, cases[i].is_kept && i ? 0 : all);
        assert_int_equal(resumed_rows, cases[i].is_kept && i ? 4 : 0);
        assert_false(has_journal("slow-1"));
    }
}

int main(void)
{
    setenv("RG_LONG_S", "1e9", 1); // lines are counted
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_interrupted_table_goes_on),
        cmocka_unit_test(tables_before_it_are_kept),
        cmocka_unit_test(what_cannot_be_printed_is_kept),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
