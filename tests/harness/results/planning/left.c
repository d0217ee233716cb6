// The time left, as a command reports it while it measures tables, by a clock that only their
// frames move. Many runs have rows that grow heavier or lighter, have peaks, or scatter. In 95 % of
// runs that report a time, each time is right within a factor of three.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/tables/runs/regenerate.h"
#include "tests/harness/results/planning/slow.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

enum { MOST_ROWS = 40, MOST_LINES = 64, MOST_TABLES = 3, RUNS = 24 };

// --- the log ---

static struct {
    int count;
    struct {
        double at_ms, left_ms; // when it was logged, and the announced rest
        char text[128];
    } lines[MOST_LINES];
    double start_ms;
} told;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    double value;
    char unit[8];
    if (sscanf(line, "about %lf %7s", &value, unit) != 2)
        return;
    assert_below(told.count, MOST_LINES);
    const double ms = value * (!strcmp(unit, "h") ? 3.6e6 : !strcmp(unit, "min") ? 6e4 : 1e3);
    const double passed_ms = rg_now_ms() - told.start_ms;
    told.lines[told.count].at_ms = rg_now_ms();
    told.lines[told.count].left_ms = strstr(line, " in all") ? ms - passed_ms : ms;
    snprintf(told.lines[told.count++].text, sizeof(told.lines[0].text), "%s", line);
}

// --- tables ---

// Rows whose frames take a given time, and their settings as text.
struct uneven {
    char sets[MOST_ROWS][64];
    struct rg_table_row rows[MOST_ROWS];
    struct rg_table table;
};

static void make(struct uneven *u, const char *technique, int rows,
                 double (*ms_of)(int row, int rows), double times)
{
    *u = (struct uneven){.table = {.id = "slow-1",
                                   .columns = {"fixed_ms"},
                                   .key_count = 1,
                                   .variants = {{"full", "", NULL}},
                                   .width = 64,
                                   .height = 64,
                                   .check_frames = 5,
                                   .row_count = rows,
                                   .rows = u->rows,
                                   .note = "a note"}};
    u->table.technique = technique;
    for (int row = 0; row < rows; row++) {
        const double ms = times * ms_of(row, rows);
        snprintf(u->sets[row], sizeof(u->sets[row]), "fixed_ms=%.3f", ms);
        u->rows[row] = (struct rg_table_row){u->sets[row], {ms}, NULL};
    }
}

static double growing(int row, int rows)
{
    return 2 * pow(150, row / (rows - 1.0));
}

static double falling(int row, int rows)
{
    return growing(rows - 1 - row, rows);
}

static double alike(int row, int rows)
{
    return 50 + 0.01 * row / rows;
}

// As in a table where each camera's last row has all the rain.
static double with_peaks(int row, int rows)
{
    return (row + 1) % (rows / 2) ? 20 + row : 400;
}

// Random, from a millisecond to a second.
static double scattered(int row, int rows)
{
    (void)row;
    (void)rows;
    return pow(10, 3 * drand48());
}

// --- a command ---

static int print(const struct rg_result *result, const void *user)
{
    (void)user;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        assert_int_equal(rg_result_at(result, at)->outcome, RG_OK);
    return 0;
}

// Measures tables, keeps the announced times, and returns when the run ended.
static double run(const struct rg_table *const tables[], int count)
{
    struct slow_rig rig;
    assert_int_equal(make_folder(NULL), 0);
    slow_begin(&rig);
    told.count = 0;
    told.start_ms = rg_now_ms();
    rg_log_listen(hear, NULL);
    const struct rg_regenerate_options options = {.fresh = true, .folder = folder, .print = print};
    assert_int_equal(rg_tables_regenerate(tables, count, &rig.devices, &options), 0);
    rg_log_listen(NULL, NULL);
    const double end_ms = rg_now_ms();
    slow_end(&rig);
    assert_int_equal(remove_whole_folder(NULL), 0);
    return end_ms;
}

// The number of lines that are right within a factor of `times`.
static int right(double end_ms, double times)
{
    int count = 0;
    for (int i = 0; i < told.count; i++) {
        const double left_ms = end_ms - told.lines[i].at_ms;
        count +=
            told.lines[i].left_ms <= times * left_ms && left_ms <= times * told.lines[i].left_ms;
    }
    return count;
}

static void what_is_told_is_right_within_three_times(void **state)
{
    (void)state;
    static double (*const shapes[])(int, int) = {growing, falling, alike, with_peaks, scattered};
    static const char *const techniques[] = {"slow", "other"};
    static struct uneven u[MOST_TABLES];
    const struct rg_table *const tables[] = {&u[0].table, &u[1].table, &u[2].table};
    int runs = 0, spoke = 0, all_right = 0, lines = 0, right_lines = 0;
    srand48(1);
    for (int number = 0; number < RUNS; number++) {
        const int count = 1 + (int)lrand48() % MOST_TABLES;
        for (int t = 0; t < count; t++)
            make(&u[t], techniques[lrand48() % 2], 4 + (int)lrand48() % 10, shapes[lrand48() % 5],
                 pow(10, drand48()));
        const double end_ms = run(tables, count);
        runs++;
        spoke += told.count > 0;
        lines += told.count;
        right_lines += right(end_ms, 3);
        all_right += told.count > 0 && right(end_ms, 3) == told.count;
    }
    print_message("%d runs: %d told a time, in %d of them each was right within three times; of %d "
                  "lines %d were\n",
                  runs, spoke, all_right, lines, right_lines);
    assert_at_least(spoke, RUNS / 2);
    assert_at_least(all_right, 0.95 * spoke);
}

// Once rows are open, the time left is known.
static void rows_that_are_alike_are_told(void **state)
{
    (void)state;
    static struct uneven u;
    const struct rg_table *const tables[] = {&u.table};
    make(&u, "slow", 20, alike, 1);
    const double end_ms = run(tables, 1);
    assert_at_least(told.count, 3);
    assert_int_equal(right(end_ms, 2), told.count);
    assert_below(told.lines[0].at_ms - told.start_ms, 0.6 * (end_ms - told.start_ms));
}

// Frames take five times as long as in the warm-up: all timed ones, or in a window those from the
// tenth on, which the first samples do not show.
static void samples_tell_their_pace(void **state)
{
    (void)state;
    static const char *const sets[] = {"late_ms=200 late_frame=6", "late_ms=200 late_frame=10"};
    static struct uneven u;
    const struct rg_table *const tables[] = {&u.table};
    for (int i = 0; i < 2; i++) {
        make(&u, "slow", 20, alike, 1);
        u.table.variants[0].set = sets[i];
        const double end_ms = run(tables, 1);
        assert_at_least(told.count, 3);
        assert_int_equal(right(end_ms, i ? 3 : 2), told.count);
    }
}

// A window of frames ends after each second sample, and the next one needs a new instance.
static void windows_are_foretold(void **state)
{
    (void)state;
    static struct uneven u;
    const struct rg_table *const tables[] = {&u.table};
    make(&u, "slow", 20, alike, 1);
    u.table.variants[0].set = "open_ms=2000";
    u.table.window_frames = 5;
    const double end_ms = run(tables, 1);
    assert_at_least(told.count, 3);
    assert_int_equal(right(end_ms, 3), told.count);
}

// The time of a table that has not begun is not estimated from others.
static void tables_that_follow_are_not_foretold(void **state)
{
    (void)state;
    static struct uneven u[2];
    const struct rg_table *const tables[] = {&u[0].table, &u[1].table};
    make(&u[0], "slow", 20, alike, 1);
    run(tables, 1);
    assert_above(told.count, 0);
    make(&u[1], "other", 20, alike, 100);
    const double end_ms = run(tables, 2);
    assert_above(told.count, 0);
    assert_int_equal(right(end_ms, 2), told.count);
}

int main(void)
{
    setenv("RG_LONG_S", "1", 1);
    if (isatty(STDERR_FILENO) && !freopen("/dev/null", "w", stderr))
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_that_are_alike_are_told),
        cmocka_unit_test(samples_tell_their_pace),
        cmocka_unit_test(windows_are_foretold),
        cmocka_unit_test(tables_that_follow_are_not_foretold),
        cmocka_unit_test(what_is_told_is_right_within_three_times),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
