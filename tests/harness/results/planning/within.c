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
#include "core/base/text/add.h"
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

static struct rg_devices wanted; // those that the command names

// The printed part of each table, and the exit status.
static struct {
    struct {
        int rows, devices, variants, works, divisor, cells;
        bool few_samples;
        char left_out[256]; // what is said to be left out; "": nothing
    } tables[TABLES];
    char turns[512], closing[128]; // the turns that were told, each with a bar, and the last line
    int printed, ended, exit;
    char left[16];           // what was told to be left at first
    double budget_s, over_s; // and after its end
    double needed_s;         // as the line that refuses the budget says; 0: no such line
    char *out;
} got;

// The rows that a result has not: "3", "2, 4", "2-4".
static void name_missing(const struct rg_result *result, char *text, size_t size)
{
    *text = 0;
    for (int row = 0; row < ROWS; row++) {
        int last = row;
        while (last < ROWS && !rg_result_has(result, last))
            last++;
        if (last == row + 1)
            rg_text_add(text, size, ", ", "%d", last);
        else if (last > row)
            rg_text_add(text, size, ", ", "%d-%d", row + 1, last);
        row = last > row ? last - 1 : row;
    }
}

// What a result lacks of its whole table, in words.
static void name_left_out(const struct rg_result *result, char *text, size_t size)
{
    char rows[64], devices[64] = "";
    name_missing(result, rows, sizeof(rows));
    *text = 0;
    if (*rows)
        rg_text_add(text, size, "; ", "rows %s", rows);
    if (result->work_count < 2)
        rg_text_add(text, size, "; ", "works but what was printed");
    if (result->variant_count < 2)
        rg_text_add(text, size, "; ", "variants that no claim is about");
    if (result->size_divisor > 1)
        rg_text_add(text, size, "; ", "whole pictures");
    if (result->few_samples)
        rg_text_add(text, size, "; ", "more than 6 samples");
    for (int d = 0; d < wanted.count; d++) {
        bool has = false;
        for (int i = 0; i < result->device_count; i++)
            has = has || !strcmp(result->devices[i].name, wanted.devices[d]->info.name);
        if (!has)
            rg_text_add(devices, sizeof(devices), ", ", "%s", wanted.devices[d]->info.name);
    }
    if (*devices)
        rg_text_add(text, size, "; ", "%s", devices);
}

// Events of a run.
struct fate {
    double passed_s; // since the command began
    bool loses_gl;
    int interrupted;
    unsigned without;     // bits of the devices that the command does not name
    int printing[TABLES]; // the exit status of printing each table
    int end;              // and of printing what stands below all
};

static int print(const struct rg_result *result, const void *user)
{
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
    assert_int_equal(result->width, 640 / result->size_divisor);
    assert_int_equal(result->height, 480 / result->size_divisor);
    assert_equals(result->budget_s, got.budget_s);
    got.tables[i].devices = result->device_count;
    got.tables[i].variants = result->variant_count;
    got.tables[i].works = result->work_count;
    got.tables[i].divisor = result->size_divisor;
    got.tables[i].few_samples = result->few_samples;
    name_left_out(result, got.tables[i].left_out, sizeof(got.tables[i].left_out));
    got.printed++;
    return ((const struct fate *)user)->printing[i];
}

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    if (!strncmp(line, "within the budget, of which ", 28))
        rg_text_add(got.turns, sizeof(got.turns), "|", "%s", strstr(line, " are left: ") + 11);
    if (!*got.left)
        sscanf(line, "within the budget, of which %15[^a] are left", got.left);
    if (strstr(line, " measured on "))
        snprintf(got.closing, sizeof(got.closing), "%s", line);
    if (strstr(line, "nothing fits into"))
        assert_int_equal(sscanf(strstr(line, "; give "), "; give %lfs or more", &got.needed_s), 1);
}

static int print_end(const void *user)
{
    got.ended++;
    return ((const struct fate *)user)->end;
}

static void expect_told(const char *words)
{
    if (!strstr(got.out, words))
        fail_msg("'%s' is not in: %s", words, got.out);
}

// A reason names what was left out first, a device or the turn of others, and what did not fit.
static void expect_why(const char *line)
{
    static const char *const known[] = {"gl",
                                        "cpu:reference",
                                        "the first rows of each table",
                                        "the other rows that are needed",
                                        "larger pictures and more samples",
                                        "all rows",
                                        "all variants",
                                        "all works"};
    char why[256];
    double needed_s, left_s;
    bool is_known = false;
    snprintf(why, sizeof(why), "%.*s", (int)strcspn(line, "\n"), line);
    const char *would = strstr(why, " would take "), *did = strstr(why, " did not end in time)");
    const size_t length = (size_t)((would ? would : did ? did : why) - why);
    for (size_t i = 0; i < sizeof(known) / sizeof(known[0]); i++)
        is_known = is_known || (strlen(known[i]) == length && !strncmp(why, known[i], length));
    if (!is_known)
        fail_msg("'%s' is no step", why);
    if (!would)
        return;
    assert_int_equal(sscanf(would, " would take %lf s, and %lf s were left)", &needed_s, &left_s),
                     2);
    assert_at_least(needed_s, left_s);
}

// Each table has one line of what is left out, or none, behind the line of the time that all took.
static void expect_left_out(int count, double budget_s)
{
    char line[512];
    int lines = 1, found = 0;
    snprintf(line, sizeof(line), "took %.0f s, of a budget of %.0f s; left out, for time:\n",
             got.over_s + budget_s, budget_s);
    assert_ptr_equal(strstr(got.out, line), got.out);
    for (int i = 0; i < count; i++) {
        const char *due = got.tables[i].rows ? got.tables[i].left_out : "all of it";
        lines += *due != 0;
        snprintf(line, sizeof(line), "\n  %-16s %s", all[i]->id, due);
        const char *at = strstr(got.out, line);
        const char *end = at ? at + strlen(line) : "";
        if (*due && *end != '\n' && strncmp(end, " (", 2) != 0)
            fail_msg("'%s' is not in: %s", line, got.out);
        if (*due && *end == ' ')
            expect_why(end + 2);
    }
    for (const char *c = got.out; *c; c++)
        found += *c == '\n';
    assert_int_equal(found, lines > 1 ? lines : 2);
    assert_int_equal(lines == 1, strstr(got.out, "\n  nothing\n") != NULL);
}

static void run(int count, double budget_s, struct fate fate)
{
    struct slow_rig rig;
    size_t size;
    free(got.out);
    memset(&got, 0, sizeof(got));
    got.budget_s = budget_s;
    FILE *out = open_memstream(&got.out, &size);
    make_tables();
    slow_begin(&rig);
    rig.fakes[2]->waits_left = fate.loses_gl ? 0 : -1;
    slow_interrupted = fate.interrupted;
    const double begin_ms = rg_now_ms() - 1000 * fate.passed_s;
    const struct rg_regenerate_options options = {.budget_s = budget_s,
                                                  .begin_ms = begin_ms,
                                                  .print = print,
                                                  .print_end = print_end,
                                                  .user = &fate};
    wanted.count = 0;
    for (int d = 0; d < rig.devices.count; d++)
        if (!(fate.without >> d & 1))
            wanted.devices[wanted.count++] = rig.devices.devices[d];
    rg_log_listen(hear, NULL);
    got.exit = rg_tables_within(all, count, &wanted, &options, out);
    rg_log_listen(NULL, NULL);
    got.over_s = (rg_now_ms() - begin_ms) / 1000 - budget_s;
    fclose(out);
    if (!got.exit) {
        expect_left_out(count, budget_s);
        assert_int_equal(got.ended, 1);
    }
    slow_end(&rig);
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
    assert_string_equal(got.turns, "the first rows of each table|the other devices|"
                                   "larger pictures and more samples|all rows|all variants|"
                                   "all works|cpu:reference");
    assert_string_equal(got.closing, "192 cells measured on 3 devices");
}

// Without cpu the first of the others begins, and cpu:reference only where it is alone.
static void other_devices_begin_without_cpu(void **state)
{
    (void)state;
    for (unsigned without = 1; without <= 5; without += 4) {
        run(1, 1e5, (struct fate){.without = without});
        assert_int_equal(got.exit, 0);
        assert_int_equal(got.tables[0].cells, ROWS * (without == 1 ? 2 : 1) * 2 * 2);
        assert_string_equal(got.turns,
                            without == 1 ? "the first rows of each table|larger pictures and more "
                                           "samples|all rows|all variants|all works|cpu:reference"
                                         : "the first rows of each table|larger pictures and more "
                                           "samples|all rows|all variants|all works");
    }
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
    assert_string_equal(got.left, "50 s ");
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

static void what_cannot_be_printed_fails(void **state)
{
    (void)state;
    run(1, 60, (struct fate){.end = RG_EXIT_HARNESS});
    assert_int_equal(got.exit, RG_EXIT_HARNESS);
    assert_int_equal(got.printed, 1);
}

// The worst status of all tables counts; those behind it are printed as well.
static void the_worst_table_counts(void **state)
{
    (void)state;
    run(2, 150, (struct fate){.printing = {RG_EXIT_FAIL, RG_EXIT_PASS}});
    assert_int_equal(got.exit, RG_EXIT_FAIL);
    assert_int_equal(got.printed, 2);
    assert_int_equal(got.ended, 1);
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
        cmocka_unit_test(other_devices_begin_without_cpu),
        cmocka_unit_test(a_device_that_fails_takes_no_other_with_it),
        cmocka_unit_test(each_table_gets_a_row_before_one_gets_more),
        cmocka_unit_test(a_budget_is_kept_but_for_one_cell),
        cmocka_unit_test(what_cannot_be_printed_fails),
        cmocka_unit_test(the_worst_table_counts),
        cmocka_unit_test(what_is_interrupted_prints_what_there_is), // last: it stays interrupted
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free(got.out);
    return failed;
}
