// The record of a group: what it says of its plan, which files are none of it, and records that
// make no table together.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/tables/farm/merge.h"
#include "tests/harness/farm/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

enum { ROWS = 3, VARIANTS = 2 };

static struct farm farm;
static char out[80];

static int begin(void **state)
{
    (void)state;
    assert_int_equal(make_folder(state), 0);
    snprintf(out, sizeof(out), "%s/out", folder);
    make_farm(&farm, 1, ROWS, VARIANTS);
    rg_text_copy(farm.plan.digest, RG_FARM_DIGEST, "0123456789abcdef");
    return 0;
}

static int end(void **state)
{
    (void)state;
    unmake_farm(&farm);
    remove_whole_folder(state);
    return 0;
}

// --- what a record says ---

static void a_record_names_its_plan_and_group(void **state)
{
    (void)state;
    struct rg_result result = measure_group(&farm, 1, 0);
    char name[RG_FARM_FILE], due[RG_OUTPUT_PART];
    json_t *json = rg_farm_record_json(&farm.plan, &farm.plan.groups[1], &result, 2.0 / 3);
    char *text = json_dumps(json_object_get(json, "group"), JSON_COMPACT | RG_JSON_FLAGS);
    assert_string_equal(
        text, "{\"plan\":\"0123456789abcdef\",\"id\":\"farm-0/2\",\"seconds\":0.666666667}");
    rg_farm_file(&farm.plan.groups[1], name);
    rg_output_part("farm-0/2", due);
    assert_memory_equal(name, due, strlen(due));
    assert_string_equal(name + strlen(due), ".json");
    free(text);
    json_decref(json);
    rg_result_free(&result);
}

// --- files that are none ---

static void write_result(int64_t group, const struct rg_result *result)
{
    assert_true(rg_farm_record_write(&farm.plan, &farm.plan.groups[group], result, 1, folder));
}

// Reads the record of the second group, and expects the reason why it is none.
static void expect_read(bool is_checked, enum rg_farm_found due, const char *says)
{
    char why[RG_WHY_SIZE];
    struct rg_result result = {0};
    const char *path = record_path(&farm, 1, folder);
    const enum rg_farm_found found =
        rg_farm_record_read(&farm.plan, &farm.plan.groups[1], path, is_checked, &result, why);
    if (!strstr(why, says))
        fail_msg("'%s' is not in: %s", says, why);
    assert_int_equal(found, due);
    assert_int_equal(rg_result_has(&result, 1), due == RG_FARM_WHOLE);
    rg_result_free(&result);
}

static void records_of_something_else_are_told(void **state)
{
    (void)state;
    expect_read(false, RG_FARM_ABSENT, "");
    // Another group's record under this one's name.
    struct rg_result other = measure_group(&farm, 2, 0), own = measure_group(&farm, 1, 0);
    char from[512];
    write_result(2, &other);
    snprintf(from, sizeof(from), "%s", record_path(&farm, 2, folder));
    assert_int_equal(rename(from, record_path(&farm, 1, folder)), 0);
    expect_read(false, RG_FARM_DAMAGED, "is of group farm-0/3, and the plan is of farm-0/2; merge");
    // The other length, and another table.
    own.full = true;
    write_result(1, &own);
    expect_read(false, RG_FARM_DAMAGED, "is of length full, and the plan is of quick; merge");
    own.full = false;
    snprintf(own.table, sizeof(own.table), "farm-9");
    write_result(1, &own);
    expect_read(false, RG_FARM_DAMAGED, "is of table farm-9, and the plan is of farm-0; merge");
    snprintf(own.table, sizeof(own.table), "farm-0");
    write_result(1, &own);
    expect_read(false, RG_FARM_WHOLE, "");
    rg_result_free(&own);
    rg_result_free(&other);
}

// Each cell of the group must be there: of its row, work, variant and device.
static void records_that_lack_a_cell_are_told(void **state)
{
    (void)state;
    static const struct {
        struct rg_farm_cell cell;
        const char *says;
    } cases[] = {{{2, "", "v1", 1, 1, false}, NULL},
                 {{3, "", "v1", 1, 1, false}, "lacks the cell farm-0/3/v1/cpu:reference; measure"},
                 {{2, "ours", "v0", 0, 1, false}, "lacks the cell farm-0/2/ours/v0/cpu; measure"},
                 {{2, "", "v2", 0, 1, false}, "lacks the cell farm-0/2/v2/cpu; measure"},
                 {{2, "", "v0", 2, 1, false}, "lacks the cell farm-0/2/v0/gl; measure"}};
    struct rg_farm_cell *last = &farm.plan.cells[2 * 2 * VARIANTS - 1];
    snprintf(farm.plan.devices[2].name, RG_NAME_SIZE, "gl");
    leave_record(&farm, 1, 0, folder);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        *last = cases[i].cell;
        expect_read(false, cases[i].says ? RG_FARM_DAMAGED : RG_FARM_WHOLE,
                    cases[i].says ? cases[i].says : "");
    }
}

static void append(const char *path, const char *text)
{
    FILE *file = fopen(path, "ab");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

// A file with more after its record is no record. Checksums count unless they were computed before.
static void records_that_were_changed_are_told(void **state)
{
    (void)state;
    struct rg_result result = measure_group(&farm, 1, 0);
    write_result(1, &result);
    append(record_path(&farm, 1, folder), "\n ");
    expect_read(false, RG_FARM_WHOLE, "");
    append(record_path(&farm, 1, folder), "{}");
    expect_read(false, RG_FARM_DAMAGED, "has more after its end; measure its group again");
    json_t *json = rg_farm_record_json(&farm.plan, &farm.plan.groups[1], &result, 1);
    json_t *cell = json_array_get(json_object_get(json, "cells"), 0);
    json_object_set_new(json_object_get(cell, "measured"), "create_ms", json_integer(5));
    assert_int_equal(json_dump_file(json, record_path(&farm, 1, folder), RG_JSON_FLAGS), 0);
    expect_read(false, RG_FARM_DAMAGED, "wrong checksum");
    expect_read(true, RG_FARM_WHOLE, "");
    json_decref(json);
    rg_result_free(&result);
}

// --- records that make a table ---

static struct rg_farm_records found;

static int merge(void)
{
    const char *const folders[] = {folder};
    rg_farm_found_free(&found);
    *logged = 0;
    assert_true(rg_farm_records_find(&found, &farm.plan, folders, 1));
    rg_log_listen(log_all, NULL);
    const int exit = rg_farm_merge(&farm.plan, &found, out);
    rg_log_listen(NULL, NULL);
    return exit;
}

static void swap_variants(struct rg_result *result)
{
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        snprintf(rg_result_at(result, at)->variant, RG_NAME_SIZE, at.variant ? "v0" : "v1");
    snprintf(result->variants[0], RG_NAME_SIZE, "v1");
    snprintf(result->variants[1], RG_NAME_SIZE, "v0");
}

static void widen(struct rg_result *result)
{
    result->width = 128;
}

static void heighten(struct rg_result *result)
{
    result->height = 128;
}

// Records whose cells would stand beside others of another kind are refused, by name.
static void records_that_differ_make_no_table(void **state)
{
    (void)state;
    static void (*const changes[])(struct rg_result *) = {swap_variants, widen, heighten};
    for (int64_t g = 0; g < ROWS; g++)
        leave_record(&farm, g, 0, folder);
    assert_int_equal(merge(), RG_EXIT_PASS);
    for (size_t i = 0; i < sizeof(changes) / sizeof(changes[0]); i++) {
        struct rg_result result = measure_group(&farm, 2, 0);
        changes[i](&result);
        write_result(2, &result);
        rg_result_free(&result);
        assert_int_equal(merge(), RG_EXIT_USAGE);
        assert_non_null(strstr(logged, record_path(&farm, 2, folder)));
        assert_non_null(strstr(logged, ": has other works, variants or devices than the table's "
                                       "other records; measure its group again"));
    }
    rg_farm_found_free(&found);
}

// Between finding and merging a record may be lost.
static void records_that_vanish_are_told(void **state)
{
    (void)state;
    const char *const folders[] = {folder};
    for (int64_t g = 0; g < ROWS; g++)
        leave_record(&farm, g, 0, folder);
    *logged = 0;
    assert_true(rg_farm_records_find(&found, &farm.plan, folders, 1));
    assert_int_equal(truncate(record_path(&farm, 1, folder), 100), 0);
    rg_log_listen(log_all, NULL);
    assert_int_equal(rg_farm_merge(&farm.plan, &found, out), RG_EXIT_USAGE);
    rg_log_listen(NULL, NULL);
    assert_non_null(strstr(logged, record_path(&farm, 1, folder)));
    assert_non_null(strstr(logged, ": was changed meanwhile; merge again"));
    rg_farm_found_free(&found);
}

// A merge ends as its cells did.
static void a_merge_ends_as_its_cells(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome outcome;
        int exit;
    } cases[] = {
        {RG_FAIL, RG_EXIT_FAIL}, {RG_UNSUPPORTED, RG_EXIT_PASS}, {RG_NOTHING, RG_EXIT_NOTHING}};
    for (int64_t g = 0; g < ROWS; g++)
        leave_record(&farm, g, 0, folder);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_result result = measure_group(&farm, 1, 0);
        rg_record_end(rg_result_at(&result, (struct rg_place){.row = 1}), cases[i].outcome,
                      "so it is");
        write_result(1, &result);
        rg_result_free(&result);
        assert_int_equal(merge(), cases[i].exit);
    }
    rg_farm_found_free(&found);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_record_names_its_plan_and_group, begin, end),
        cmocka_unit_test_setup_teardown(records_of_something_else_are_told, begin, end),
        cmocka_unit_test_setup_teardown(records_that_lack_a_cell_are_told, begin, end),
        cmocka_unit_test_setup_teardown(records_that_were_changed_are_told, begin, end),
        cmocka_unit_test_setup_teardown(records_that_differ_make_no_table, begin, end),
        cmocka_unit_test_setup_teardown(records_that_vanish_are_told, begin, end),
        cmocka_unit_test_setup_teardown(a_merge_ends_as_its_cells, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
