// A shard of a farm: the groups that it measures, those that it finds measured, and how it ends, by
// a clock that only frames move.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/record/passport/build_info.h"
#include "harness/tables/farm/groups.h"
#include "harness/tables/farm/record.h"
#include "tests/harness/results/planning/slow.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"
#include "tests/tools/process/printed.h"

enum { ROWS = 4, DEVICES = 3 };

static const struct rg_table_row rows[] = {{"fixed_ms=2", {1}, "a"},
                                           {"fixed_ms=4", {2}, "b"},
                                           {"fixed_ms=8", {3}, "c"},
                                           {"fixed_ms=16", {4}, "d"}};
static const struct rg_table table = {.id = "slow-1",
                                      .technique = "slow",
                                      .columns = {"fixed_ms"},
                                      .key_count = 1,
                                      .variants = {{"full", "", NULL}},
                                      .width = 64,
                                      .height = 64,
                                      .check_frames = 5,
                                      .row_count = ROWS,
                                      .rows = rows,
                                      .note = "a note"};

static struct rg_farm_plan plan;
static struct slow_rig rig;
static const char *printed;

// --- a plan ---

static void add_group(const char *id, const char *of, const char *its_rows, double seconds)
{
    assert_true(rg_farm_add_group(&plan, of, id));
    for (const char *row = its_rows; *row; row++)
        for (int d = 0; d < DEVICES; d++)
            assert_true(rg_farm_add_cell(
                &plan, &(struct rg_farm_cell){
                           .row = *row - '0', .variant = "full", .device = d, .seconds = seconds}));
}

// Three groups, the first with a gap. Cut into two shards, the first has the largest, and the
// second the two others.
static int begin(void **state)
{
    plan = (struct rg_farm_plan){.digest = "0123456789abcdef", .device_count = DEVICES};
    rg_text_copy(plan.commit, sizeof(plan.commit), rg_build_commit);
    slow_begin(&rig);
    for (int d = 0; d < DEVICES; d++)
        rg_text_copy(plan.devices[d].name, RG_NAME_SIZE, rig.devices.devices[d]->info.name);
    add_group("slow-1/1,3", "slow-1", "13", 100);
    add_group("slow-1/2", "slow-1", "2", 40);
    add_group("slow-1/4", "slow-1", "4", 20);
    rg_farm_sum(&plan);
    return make_folder(state);
}

static int end(void **state)
{
    slow_end(&rig);
    rg_farm_plan_free(&plan);
    remove_whole_folder(state);
    return 0;
}

static const struct rg_table *find(const char *id)
{
    return strcmp(id, table.id) ? NULL : &table;
}

// Measures a shard, and keeps what it prints and logs.
static int measure(int number, int count)
{
    const struct rg_shard shard = {number, count};
    *logged = 0;
    slow_opened = 0;
    rg_log_listen(log_all, NULL);
    printed_begin();
    const int exit = rg_farm_measure(&plan, &shard, &rig.devices, find, folder);
    printed = printed_end();
    rg_log_listen(NULL, NULL);
    return exit;
}

// The record of a group; its rows as digits.
static enum rg_farm_found found_of(int group, char has[ROWS + 1], enum rg_outcome *worst)
{
    char name[RG_FARM_FILE], path[512], why[RG_WHY_SIZE];
    struct rg_result result = {0};
    rg_farm_file(&plan.groups[group], name);
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    const enum rg_farm_found found =
        rg_farm_record_read(&plan, &plan.groups[group], path, false, &result, why);
    *worst = RG_OK;
    for (int row = 0; row < ROWS; row++)
        if (rg_result_has(&result, row))
            *has++ = (char)('1' + row);
    *has = 0;
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);) {
        const struct rg_record *record = rg_result_at(&result, at);
        *worst = record->outcome ? record->outcome : *worst;
        assert_true(record->outcome || rg_record_is_whole(record));
    }
    rg_result_free(&result);
    return found;
}

static void expect_rows(int group, const char *due)
{
    char has[ROWS + 1];
    enum rg_outcome worst;
    assert_int_equal(found_of(group, has, &worst), *due ? RG_FARM_WHOLE : RG_FARM_ABSENT);
    assert_string_equal(has, due);
    assert_int_equal(worst, RG_OK);
}

static void expect_heard(const char *words)
{
    if (!strstr(logged, words))
        fail_msg("'%s' is not in: %s", words, logged);
}

// --- shards ---

static void a_shard_measures_its_own_groups(void **state)
{
    (void)state;
    assert_int_equal(measure(2, 2), RG_EXIT_PASS);
    expect_rows(0, "");
    expect_rows(1, "2");
    expect_rows(2, "4");
    expect_heard("shard 2 of 2: 0 of 2 groups were there");
    expect_heard("6 cells measured on 3 devices");
    assert_int_equal(measure(1, 2), RG_EXIT_PASS);
    expect_rows(0, "13");
    expect_heard("shard 1 of 2: 0 of 1 groups were there");
    expect_heard("6 cells measured on 3 devices");
}

// A line a group: what was measured, how long it took, and how long it was expected to take.
static void groups_are_told_with_their_times(void **state)
{
    (void)state;
    char took[RG_DURATION_TEXT], due[128];
    const double start_ms = rg_now_ms();
    assert_int_equal(measure(1, 2), RG_EXIT_PASS);
    snprintf(due, sizeof(due), "slow-1/1,3: 6 cells, %s, expected 10 min\n",
             rg_duration_text((rg_now_ms() - start_ms) / 1000, took));
    assert_string_equal(printed, due);
    char name[RG_FARM_FILE], path[512];
    json_error_t error;
    rg_farm_file(&plan.groups[0], name);
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    json_t *json = json_load_file(path, 0, &error);
    assert_non_null(json);
    const double seconds =
        json_number_value(json_object_get(json_object_get(json, "group"), "seconds"));
    assert_below(fabs(seconds - (rg_now_ms() - start_ms) / 1000), 1e-3);
    assert_string_equal(json_string_value(json_object_get(json, "length")), "quick");
    json_decref(json);
}

// A shard that is begun again does what is left: groups without a record, or with a damaged one.
static void a_shard_goes_on(void **state)
{
    (void)state;
    char name[RG_FARM_FILE], path[512];
    assert_int_equal(measure(1, 1), RG_EXIT_PASS);
    assert_int_equal(measure(1, 1), RG_EXIT_PASS);
    assert_string_equal(printed, "");
    assert_string_equal(logged, "shard 1 of 1: 3 of 3 groups were there\n");
    assert_int_equal(slow_opened, 0);
    rg_farm_file(&plan.groups[1], name);
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    assert_int_equal(truncate(path, 100), 0);
    assert_int_equal(measure(1, 1), RG_EXIT_PASS);
    expect_heard("; measure its group again: that is done now\n");
    expect_heard("shard 1 of 1: 2 of 3 groups were there\n");
    assert_memory_equal(printed, "slow-1/2: 3 cells, ", 19);
    expect_rows(1, "2");
}

static void a_shard_without_groups_is_refused(void **state)
{
    (void)state;
    assert_int_equal(measure(4, 4), RG_EXIT_NOTHING);
    expect_heard("shard 4 of 4: has none of 3 groups; cut the plan into 3 shards at most");
}

// A group that cannot be measured is told, and the others are measured.
static void a_group_that_is_not_of_this_program(void **state)
{
    (void)state;
    snprintf(plan.groups[1].table, RG_NAME_SIZE, "slow-9");
    assert_int_equal(measure(1, 1), RG_EXIT_USAGE);
    expect_heard("slow-1/2: this raingauge has no such table; plan with it\n");
    expect_rows(2, "4");
    snprintf(plan.groups[1].table, RG_NAME_SIZE, "slow-1");
    snprintf(plan.digest, sizeof(plan.digest), "fedcba9876543210");
    assert_int_equal(measure(1, 1), RG_EXIT_USAGE);
    expect_heard("is of plan 0123456789abcdef, and the plan is of fedcba9876543210; ");
    expect_rows(1, "2");
}

// Cells that fail have a record, and the shard ends as they did, then and whenever it goes on.
static void a_shard_ends_as_its_cells(void **state)
{
    (void)state;
    char has[ROWS + 1];
    enum rg_outcome worst;
    rig.fakes[2]->waits_left = 0;
    assert_int_equal(measure(2, 2), RG_EXIT_FAIL);
    expect_heard("4 of 6 cells measured on 3 devices; 2 failed");
    assert_int_equal(found_of(1, has, &worst), RG_FARM_WHOLE);
    assert_string_equal(has, "2");
    assert_int_not_equal(worst, RG_OK);
    assert_int_equal(measure(2, 2), RG_EXIT_FAIL);
    expect_heard("shard 2 of 2: 2 of 2 groups were there");
}

int main(void)
{
    setenv("RG_PROBE_S", "0", 1);
    setenv("RG_LONG_S", "1e9", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_shard_measures_its_own_groups, begin, end),
        cmocka_unit_test_setup_teardown(groups_are_told_with_their_times, begin, end),
        cmocka_unit_test_setup_teardown(a_shard_goes_on, begin, end),
        cmocka_unit_test_setup_teardown(a_shard_without_groups_is_refused, begin, end),
        cmocka_unit_test_setup_teardown(a_group_that_is_not_of_this_program, begin, end),
        cmocka_unit_test_setup_teardown(a_shard_ends_as_its_cells, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
