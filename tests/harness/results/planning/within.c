// Tables within a budget of time, by a clock that only their frames move: the order, the tables
// that are skipped, and whether the budget is kept.
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

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/tables/runs/budget.h"
#include "tests/harness/results/planning/slow.h"
#include "tests/tools/expect.h"

enum { TABLES = 4, ROWS = 4 };

// Four rows; the first, the second and the last are needed.
static const struct rg_table_row light[] = {
    {"", {1}, "a"}, {"", {2}, "b"}, {"", {3}, "c"}, {"", {4}, "d"}};
static const struct rg_table_row heavy[] = {{"fixed_ms=400", {1}, "a"},
                                            {"fixed_ms=400", {2}, "b"},
                                            {"fixed_ms=400", {3}, "c"},
                                            {"fixed_ms=400", {4}, "d"}};
// Two techniques with two tables each; the second one is heavy.
static const struct rg_table table = {.id = "slow-1",
                                      .technique = "slow",
                                      .columns = {"fixed_ms"},
                                      .key_count = 1,
                                      .variants = {{"full", "", NULL}, {"bare", "", NULL}},
                                      .works = {{.name = "paper", .set = "", .saves = ""},
                                                {.name = "ours", .set = "", .saves = "all"}},
                                      .width = 640,
                                      .height = 480,
                                      .check_frames = 5,
                                      .row_count = ROWS,
                                      .rows = light,
                                      .note = "a note"};
static struct rg_table tables[TABLES];
static const struct rg_table *const all[] = {&tables[0], &tables[1], &tables[2], &tables[3]};

static void make_tables(void)
{
    static const char *const ids[] = {"slow-1", "slow-2", "other-1", "other-2"};
    for (int i = 0; i < TABLES; i++) {
        tables[i] = table;
        tables[i].id = ids[i];
        tables[i].technique = i < 2 ? "slow" : "other";
        tables[i].rows = i % 2 ? heavy : light;
    }
}

// --- a command ---

// The printed part of each table, and the exit status.
static struct {
    struct {
        int rows, devices, variants, works, divisor, cells;
        bool few_samples;
    } tables[TABLES];
    int printed, exit;
    double over_s;   // after the end of the budget
    double needed_s; // as the line that refuses the budget says; 0: no such line
    char *out;
} got;

static int print(const struct rg_result *result, const void *user)
{
    (void)user;
    int i = 0;
    while (strcmp(all[i]->id, result->table) != 0)
        i++;
    for (int row = 0; row < ROWS; row++)
        got.tables[i].rows += rg_result_has(result, row);
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        assert_true(rg_record_is_whole(record));
        got.tables[i].cells += record->outcome == RG_OK && record->sample_count > 0;
    }
    assert_above(rg_result_first_missing(result), result->last_row);
    got.tables[i].devices = result->device_count;
    got.tables[i].variants = result->variant_count;
    got.tables[i].works = result->work_count;
    got.tables[i].divisor = result->size_divisor;
    got.tables[i].few_samples = result->few_samples;
    got.printed++;
    return 0;
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    if (strstr(line, "nothing fits into"))
        assert_int_equal(sscanf(strstr(line, "; give "), "; give %lfs or more", &got.needed_s), 1);
}

// Events of a run.
struct fate {
    double passed_s; // since the command began
    bool loses_gl;
    int interrupted;
};

static void run(int count, double budget_s, struct fate fate)
{
    struct slow_rig rig;
    size_t size;
    free(got.out);
    memset(&got, 0, sizeof(got));
    FILE *out = open_memstream(&got.out, &size);
    make_tables();
    slow_begin(&rig);
    rig.fakes[2]->waits_left = fate.loses_gl ? 0 : -1;
    slow_interrupted = fate.interrupted;
    const double begin_ms = rg_now_ms() - 1000 * fate.passed_s;
    const struct rg_regenerate_options options = {
        .budget_s = budget_s, .begin_ms = begin_ms, .print = print};
    rg_log_listen(hear, NULL);
    got.exit = rg_tables_within(all, count, &rig.devices, &options, out);
    rg_log_listen(NULL, NULL);
    got.over_s = (rg_now_ms() - begin_ms) / 1000 - budget_s;
    fclose(out);
    slow_end(&rig);
}

static void expect_told(const char *words)
{
    if (!strstr(got.out, words))
        fail_msg("'%s' is not in: %s", words, got.out);
}

// The longest time of a cell. First its image by cpu:reference, which is ten times as slow, and a
// frame without rain. Then its frames on gl, three times as slow, of the largest picture and the
// most samples.
static const double most_cell_s = 1e-3 * ((400 + 50 + 2 * 10 * 440) + 1000 + 40 * 3 * 440);

// --- the order ---

static void all_is_measured_where_there_is_time(void **state)
{
    (void)state;
    run(TABLES, 1e5, (struct fate){0});
    assert_int_equal(got.exit, 0);
    assert_int_equal(got.printed, TABLES);
    for (int i = 0; i < TABLES; i++) {
        assert_int_equal(got.tables[i].rows, ROWS);
        assert_int_equal(got.tables[i].devices, 3);
        assert_int_equal(got.tables[i].variants, 2);
        assert_int_equal(got.tables[i].works, 2);
        assert_int_equal(got.tables[i].cells, ROWS * 3 * 2 * 2);
        assert_int_equal(got.tables[i].divisor, 1);
        assert_false(got.tables[i].few_samples);
    }
    expect_told("left out, for time:\n  nothing\n");
}

// In the smallest budget each table gets a row, though not all get what they need. Once all do,
// they do in every larger budget.
static void each_table_gets_a_row_before_one_gets_more(void **state)
{
    (void)state;
    int full = 0;
    for (double s = 60; s < 600; s *= 2.2) {
        int least = ROWS, with_gl = 0;
        run(TABLES, s, (struct fate){0});
        for (int i = 0; i < TABLES; i++) {
            least = got.tables[i].rows < least ? got.tables[i].rows : least;
            with_gl += got.tables[i].devices > 1;
        }
        assert_above(least, 0);
        assert_true(!with_gl || got.tables[0].rows >= 3);
        full += least >= 3;
        assert_true(!full || least >= 3);
    }
    assert_above(full, 0);
}

// --- a budget is kept ---

static void a_budget_is_kept_but_for_one_cell(void **state)
{
    (void)state;
    for (double s = 3; s < 2000; s *= 2.2) {
        run(TABLES, s, (struct fate){0});
        if (got.over_s > most_cell_s)
            fail_msg("%.1f s of %.1f s are too much", got.over_s, s);
        assert_int_equal(got.exit, got.needed_s > 0 ? RG_EXIT_USAGE : 0);
        // The rest of the budget is less than the skipped steps would take.
        assert_true(got.over_s > -0.5 * s || strstr(got.out, "  nothing\n"));
    }
}

// The budget counts from the command's start, however long before the first table.
static void a_budget_begins_with_the_command(void **state)
{
    (void)state;
    run(TABLES, 100, (struct fate){.passed_s = 50});
    const int late_rows = got.tables[0].rows + got.tables[1].rows;
    assert_at_most(got.over_s, most_cell_s);
    run(TABLES, 50, (struct fate){0});
    assert_int_equal(got.tables[0].rows + got.tables[1].rows, late_rows);
}

// A skipped step is reported with the time that it would take.
static void what_would_not_end_in_time_is_skipped(void **state)
{
    (void)state;
    run(2, 30, (struct fate){0});
    assert_true(got.tables[0].devices > 1 || got.tables[0].rows >= 3); // the light table goes on
    assert_below(got.tables[1].rows, 3);
    expect_told("  slow-2 ");
    expect_told(" would take ");
    expect_told(" s were left)\n");
    assert_null(strstr(got.out, " did not end in time")); // nothing is begun after the end
}

// The refusal names a budget that is enough.
static void a_budget_for_no_row_is_refused(void **state)
{
    (void)state;
    for (double passed_s = 0; passed_s < 20; passed_s += 10) {
        run(TABLES, 0.5, (struct fate){.passed_s = passed_s});
        assert_int_equal(got.exit, RG_EXIT_USAGE);
        assert_int_equal(got.printed, 0);
        assert_above(got.needed_s, passed_s);
        run(TABLES, got.needed_s, (struct fate){.passed_s = passed_s});
        assert_int_equal(got.exit, 0);
        assert_above(got.printed, 0);
    }
}

// --- failures ---

// A device that fails has records that say so, and leaves its time to others.
static void a_device_that_fails_takes_no_other_with_it(void **state)
{
    (void)state;
    run(1, 1e4, (struct fate){.loses_gl = true});
    assert_int_equal(got.tables[0].devices, 3);
    assert_int_equal(got.tables[0].cells, ROWS * 2 * 2 * 2);
}

// Results from before the interruption are printed.
static void what_is_interrupted_prints_what_there_is(void **state)
{
    (void)state;
    run(TABLES, 1e4, (struct fate){.interrupted = 30});
    assert_int_equal(got.exit, RG_EXIT_SIGNALLED + SIGINT);
    assert_above(got.printed, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_budget_for_no_row_is_refused),
        cmocka_unit_test(a_budget_begins_with_the_command),
        cmocka_unit_test(what_would_not_end_in_time_is_skipped),
        cmocka_unit_test(all_is_measured_where_there_is_time),
        cmocka_unit_test(a_device_that_fails_takes_no_other_with_it),
        cmocka_unit_test(each_table_gets_a_row_before_one_gets_more),
        cmocka_unit_test(a_budget_is_kept_but_for_one_cell),
        cmocka_unit_test(what_is_interrupted_prints_what_there_is), // last: it stays interrupted
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free(got.out);
    return failed;
}
