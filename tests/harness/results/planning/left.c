// How long it still takes, as a command tells it while it measures tables of uneven rows in full,
// by a clock that only their frames move: once a tenth is done within 20 % of what it takes then.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/tables/measuring/cell.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/runs/regenerate.h"
#include "tests/harness/results/planning/slow.h"

enum { MOST_ROWS = 40, MOST_LINES = 32 };

// --- what is told ---

static struct {
    int count, in_all;     // lines of what is left, and of how long all takes
    double all, reference; // what those tell, and those of cpu:reference; in seconds, 0: none does
    struct {
        double at_ms, low_ms, high_ms; // when it was told, and what its digits stand for
        char text[128];
    } lines[MOST_LINES];
} told;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    double value, unit_ms;
    char unit[8];
    if (sscanf(line, "about %lf %7s", &value, unit) != 2)
        return;
    unit_ms = !strcmp(unit, "h") ? 3.6e6 : !strcmp(unit, "min") ? 6e4 : 1e3;
    if (strstr(line, " in all")) {
        told.in_all++;
        told.all = value * unit_ms * 1e-3;
    }
    if (strstr(line, " of it are cpu:reference's alone; "))
        told.reference = value * unit_ms * 1e-3;
    if (!strstr(line, " left; now: "))
        return;
    assert_true(told.count < MOST_LINES);
    const double half = strchr(line, '.') && strchr(line, '.') < strstr(line, unit) ? 0.05 : 0.5;
    told.lines[told.count].at_ms = rg_now_ms();
    told.lines[told.count].low_ms = (value - half) * unit_ms;
    told.lines[told.count].high_ms = (value + half) * unit_ms;
    snprintf(told.lines[told.count++].text, sizeof(told.lines[0].text), "%s", line);
}

// --- tables ---

// Rows whose frames take so long, and their settings as text.
struct uneven {
    char sets[MOST_ROWS][64];
    struct rg_table_row rows[MOST_ROWS];
    struct rg_table table;
};

static void make(struct uneven *u, const char *id, int rows, double (*ms_of)(int row, int rows))
{
    *u = (struct uneven){.table = {.technique = "slow",
                                   .columns = {"fixed_ms"},
                                   .key_count = 1,
                                   .variants = {{"full", "", NULL}},
                                   .width = 256,
                                   .height = 256,
                                   .check_frames = 5,
                                   .row_count = rows,
                                   .rows = u->rows,
                                   .note = "a note"}};
    u->table.id = id;
    for (int row = 0; row < rows; row++) {
        snprintf(u->sets[row], sizeof(u->sets[row]), "fixed_ms=%.3f", ms_of(row, rows));
        u->rows[row] = (struct rg_table_row){u->sets[row], {ms_of(row, rows)}, NULL};
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
    return 5 + 0.01 * row / rows;
}

// As where each camera's last row is the whole rain.
static double with_peaks(int row, int rows)
{
    return (row + 1) % (rows / 2) ? 20 + row : 400;
}

// --- a command ---

static int print(const struct rg_result *result, const void *user)
{
    (void)user;
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        assert_int_equal(rg_result_at(result, at)->outcome, RG_OK);
    return 0;
}

// Measures them, of which the instance with this number is interrupted (0: none), hears what is
// told, and returns when it ended. `exit` is due.
static double run(const struct rg_table *const tables[], int count, int interrupted, int exit)
{
    char folder[] = "/tmp/raingauge-left-XXXXXX", command[64];
    struct slow_rig rig;
    assert_non_null(mkdtemp(folder));
    told.count = told.in_all = 0;
    told.all = told.reference = 0;
    slow_begin(&rig);
    slow_interrupted = interrupted;
    rg_log_listen(hear, NULL);
    const struct rg_regenerate_options options = {
        .full = true, .fresh = true, .folder = folder, .print = print};
    assert_int_equal(rg_tables_regenerate(tables, count, &rig.devices, &options), exit);
    rg_log_listen(NULL, NULL);
    const double end_ms = rg_now_ms();
    slow_end(&rig);
    snprintf(command, sizeof(command), "rm -r %s", folder);
    assert_int_equal(system(command), 0);
    return end_ms;
}

// Lines that are told once the table `from` is opened are held against what it took then.
static void check(const struct rg_table *const tables[], int count, const char *from)
{
    const double end_ms = run(tables, count, 0, 0);
    assert_true(told.count >= 7);
    bool is_opened = false;
    for (int i = 0; i < told.count; i++) {
        is_opened = is_opened || strstr(told.lines[i].text, from);
        if (!is_opened)
            continue;
        const double left_ms = end_ms - told.lines[i].at_ms;
        if (told.lines[i].low_ms > 1.2 * left_ms || told.lines[i].high_ms < 0.8 * left_ms)
            fail_msg("'%s', and it took %.0f s", told.lines[i].text, left_ms / 1000);
    }
    assert_true(is_opened);
}

static void what_is_left_is_told_within_a_fifth(void **state)
{
    (void)state;
    static double (*const shapes[])(int, int) = {growing, falling, alike, with_peaks};
    static struct uneven u[4];
    for (int i = 0; i < 4; i++) {
        make(&u[0], "slow-1", 18, shapes[i]);
        check((const struct rg_table *const[]){&u[0].table}, 1, "slow-1");
    }
    // Light tables first, and heavy ones last, or the other way round.
    for (int turn = 0; turn < 2; turn++) {
        make(&u[turn ? 3 : 0], "slow-1", 40, alike);
        make(&u[1], "slow-2", 12, growing);
        make(&u[2], "slow-3", 6, falling);
        make(&u[turn ? 0 : 3], "slow-4", 18, with_peaks);
        check((const struct rg_table *const[]){&u[0].table, &u[1].table, &u[2].table, &u[3].table},
              4, "slow-");
    }
}

// Frames that take far longer once rain has built up, of one technique and not of another, which
// pictures of another width stand for: the first, or the second. Told from a row of `from` on. As
// in tables of such techniques many frames are simulated before the one that is checked.
static void check_late(const char *set, int technique, const char *from)
{
    static const char *const ids[] = {"slow-1", "slow-2", "slow-3", "slow-4"};
    static struct uneven u[4];
    for (int i = 0; i < 4; i++) {
        const bool is_late = i / 2 == technique;
        make(&u[i], ids[i], i % 2 ? 12 : 18, is_late ? alike : growing);
        u[i].table.width = i < 2 ? 256 : 128;
        u[i].table.check_frames = 20;
        for (int row = 0; is_late && row < u[i].table.row_count; row++)
            strcat(u[i].sets[row], set);
    }
    check((const struct rg_table *const[]){&u[0].table, &u[1].table, &u[2].table, &u[3].table}, 4,
          from);
}

static void rain_that_builds_up_is_foreseen(void **state)
{
    (void)state;
    check_late(" late_ms=300", 0, "slow-");
    check_late(" late_ms=300", 1, "slow-");
}

// Late not on cpu, where this is looked at, but elsewhere: told once the first rows are open.
static void what_is_left_follows_from_what_was_opened(void **state)
{
    (void)state;
    check_late(" late_ms=300 late_on_cpu=0", 0, "slow-1");
    check_late(" late_ms=300 late_on_cpu=0", 1, "slow-3, rows");
}

// Ten times what cpu takes for each cell; what checks the rows is no cell of it.
static void what_the_reference_takes_is_told_apart(void **state)
{
    (void)state;
    static struct uneven u;
    const struct rg_table *const tables[] = {&u.table};
    double due_s = 0;
    make(&u, "slow-1", 18, alike);
    for (int row = 0; row < 18; row++) {
        const double frame_ms = 1 + alike(row, 18) + 1.25e-4 * 256 * 256;
        const struct rg_cell_frames frames = {400, 10, 10 * frame_ms};
        due_s += 1e-3 * rg_cell_ms(&u.table, &frames, rg_table_options(true));
    }
    run(tables, 1, 0, 0);
    assert_true(fabs(told.reference - due_s) < 1); // two digits
    assert_true(told.reference < told.all);
}

// What a forecast had found when it was interrupted is a part of it, and is told nobody.
static void an_interrupted_forecast_is_not_told(void **state)
{
    (void)state;
    static struct uneven u;
    const struct rg_table *const tables[] = {&u.table};
    make(&u, "slow-1", 18, alike);
    run(tables, 1, 0, 0);
    assert_int_equal(told.in_all, 1);
    run(tables, 1, 5, 128 + SIGINT); // of the 21 that the forecast opens
    assert_int_equal(told.in_all, 0);
}

int main(void)
{
    setenv("RG_LONG_S", "1", 1);
    if (isatty(STDERR_FILENO) && !freopen("/dev/null", "w", stderr))
        return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_left_is_told_within_a_fifth),
        cmocka_unit_test(rain_that_builds_up_is_foreseen),
        cmocka_unit_test(what_is_left_follows_from_what_was_opened),
        cmocka_unit_test(what_the_reference_takes_is_told_apart),
        cmocka_unit_test(an_interrupted_forecast_is_not_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
