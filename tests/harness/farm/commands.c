// What plan, merge and a shard's table ask for and print, without a device.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/measure/calibration.h"
#include "harness/record/disk/stored.h"
#include "harness/record/passport/build_info.h"
#include "harness/tables/farm/found.h"
#include "harness/tables/farm/groups.h"
#include "harness/tables/farm/make.h"
#include "harness/tables/farm/merge.h"
#include "tests/harness/cli/asked.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

static int64_t known;   // cells of records
static int lacking;     // a bit for each group without a record
static int64_t missing; // cells

void rg_calibration_take(struct rg_calibration *calibration)
{
    assert_non_null(calibration->load);
}

void rg_calibration_tell(const struct rg_calibration *calibration, double *begin_ms, double *end_ms)
{
    (void)calibration;
    *begin_ms = 3.5;
    *end_ms = 9;
}

bool rg_stored_read(struct rg_stored *stored, const char *path)
{
    (void)stored;
    asked_note("from %s; ", path);
    return true;
}

// The second group takes seven seconds, and each other one.
int64_t rg_farm_expect(struct rg_farm_plan *plan, const struct rg_table *const tables[], int count,
                       const struct rg_stored *stored, double load_ms)
{
    (void)stored;
    assert_string_equal(plan->commit, rg_build_commit);
    for (int i = 0; i < count; i++)
        asked_note("%s ", tables[i]->id);
    for (int d = 0; d < plan->device_count; d++)
        asked_note("on %s ", plan->devices[d].asked);
    asked_note("in %d%s, load %g", plan->shards, plan->full ? ", full" : "", load_ms);
    for (int64_t g = 0; g < plan->group_count; g++)
        for (int i = 0; i < plan->groups[g].cell_count; i++)
            plan->cells[plan->groups[g].first_cell + i].seconds = i ? 0 : g == 1 ? 7 : 1;
    return known;
}

bool rg_farm_records_find(struct rg_farm_records *found, const struct rg_farm_plan *plan,
                          const char *const *folders, int count)
{
    for (int i = 0; i < count; i++)
        asked_note("%s ", folders[i]);
    found->first_of = calloc((size_t)plan->group_count, sizeof(*found->first_of));
    for (int64_t g = 0; g < plan->group_count; g++)
        found->first_of[g] = lacking >> g & 1 ? -1 : 0;
    found->count = lacking == 15 ? 0 : 1;
    found->records = calloc(1, sizeof(*found->records));
    return true;
}

int64_t rg_farm_missing(const struct rg_farm_records *found, const struct rg_farm_plan *plan)
{
    (void)found;
    (void)plan;
    return missing;
}

int rg_farm_merge(const struct rg_farm_plan *plan, const struct rg_farm_records *found,
                  const char *folder)
{
    (void)found;
    asked_note("merge %d cells into %s", (int)plan->cell_count, folder);
    return RG_EXIT_FAIL;
}

int rg_farm_measure(const struct rg_farm_plan *plan, const struct rg_shard *shard,
                    const struct rg_devices *devices,
                    const struct rg_table *(*find)(const char *id), const char *folder)
{
    (void)find;
    asked_note("measure %d/%d of %d cells on %d into %s; ", shard->number, shard->count,
               (int)plan->cell_count, devices->count, folder);
    return RG_EXIT_INCONCLUSIVE;
}

// --- plans ---

static int setup(void **state)
{
    known = 4;
    lacking = 0;
    missing = 0;
    return asked_setup(state);
}

#define TOLD "plan.json: 4 cells in 4 groups, expected 10 s; the largest is raster-1/2, 7 s\n"

// A plan says how long all takes, its largest group and its longest shard.
static void plans_are_asked_for(void **state)
{
    (void)state;
    asked_expect("plan raster-1 --quick --shards 2 -o plan.json", "raster-1 on cpu in 2, load 3.5",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed, TOLD "2 shards: the longest 7 s, the mean 5 s\n");
    assert_string_equal(asked_logged, "");
    asked_expect("plan raster-1 -o plan.json --from records",
                 "from records; raster-1 on cpu in 0, "
                 "load 3.5",
                 RG_EXIT_PASS);
    assert_string_equal(asked_printed, TOLD);
    asked_expect(
        "plan ye-1 raster-1 feng-1 ye-1 --full --device cpu:reference,new=cpu@OMP_NUM_THREADS=1 -o "
        "p.json",
        "feng-1 raster-1 ye-1 on cpu:reference on new=cpu@OMP_NUM_THREADS=1 in 0, full, load 3.5",
        RG_EXIT_PASS);
    known = 1;
    asked_run("plan raster-1 -o plan.json");
    assert_string_equal(asked_logged, "3 of 4 cells are in no record, so that their times are "
                                      "guessed by those of other cells; --from names records");
    known = 0;
    asked_run("plan raster-1 -o plan.json");
    assert_string_equal(asked_logged, "4 of 4 cells are in no record, so that their times are "
                                      "guessed by how fast this machine is; --from names records");
    known = -1; // without memory
    assert_int_not_equal(asked_run("plan raster-1 -o none.json"), RG_EXIT_PASS);
    assert_string_equal(asked_printed, "");
    asked_expect("plan raster-2 -o plan.json", "", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "table 'raster-2': unknown; the nearest is 'raster-1', and "
                                      "`raingauge list tables` prints them");
}

// The shards of groups without a record, as Slurm takes them.
static void what_is_missing_is_printed(void **state)
{
    (void)state;
    static const struct {
        const char *plan, *more;
        int lacking;
        const char *printed;
    } rows[] = {{"two", "", 0, ""},
                {"two", "", 2, "1\n"},
                {"two", "", 8, "2\n"},
                {"two", "", 6, "1-2\n"},
                {"two", " --shards 2", 1, "2\n"},
                {"any", " --shards 4", 9, "2,4\n"},
                {"any", " --shards 1", 15, "1\n"}};
    asked_run("plan raster-1 --shards 2 -o two");
    asked_run("plan raster-1 -o any");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char line[128];
        lacking = rows[i].lacking;
        snprintf(line, sizeof(line), "plan --missing %s a b%s", rows[i].plan, rows[i].more);
        asked_expect(line, "a b ", RG_EXIT_PASS);
        assert_string_equal(asked_printed, rows[i].printed);
    }
    asked_expect("plan --missing two a --shards 3", "", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "--shards 3: the plan is cut into 2; leave it out");
    asked_expect("plan --missing any a", "", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "plan --missing: the plan does not say how many shards there "
                                      "are; add --shards N");
    asked_expect("plan --missing two", "", RG_EXIT_USAGE);
}

// --- merges and shards ---

// Records with missing cells are merged only on request, and never if all are missing.
static void merges_are_asked_for(void **state)
{
    (void)state;
    asked_run("plan raster-1 -o plan.json");
    asked_expect("merge plan.json a b -o out", "a b merge 4 cells into out", RG_EXIT_FAIL);
    missing = 3;
    asked_expect("merge plan.json a -o out", "a ", RG_EXIT_INCONCLUSIVE);
    assert_string_equal(asked_logged,
                        "plan.json: 3 of 4 cells are missing, and nothing is merged; "
                        "`raingauge plan --missing` names their shards, and --partial "
                        "merges the others");
    asked_expect("merge plan.json a -o out --partial", "a merge 4 cells into out", RG_EXIT_FAIL);
    lacking = 15;
    asked_expect("merge plan.json a -o out --partial", "a ", RG_EXIT_NOTHING);
    asked_expect("merge plan.json a b -o a", "", RG_EXIT_USAGE);
    asked_expect("merge plan.json a b -o b", "", RG_EXIT_USAGE);
    assert_string_equal(asked_logged,
                        "-o b: holds the records that are merged; name another folder");
    asked_expect("merge plan.json -o out", "", RG_EXIT_USAGE);
}

// A shard is measured on the plan's devices, by the raingauge that made the plan.
static void shards_are_asked_for(void **state)
{
    (void)state;
    asked_run(
        "plan raster-1 --shards 3 --device cpu:reference,new=cpu@OMP_NUM_THREADS=1 -o plan.json");
    asked_expect(
        "table --plan plan.json --shard 2/3 -o out --timeout 9",
        "memory 0; open cpu:reference,new=cpu@OMP_NUM_THREADS=1, require -, 9 s; measure 2/3 of 8 "
        "cells on 2 into out; close 2",
        RG_EXIT_INCONCLUSIVE);
    asked_left_out = RG_EXIT_FAIL;
    assert_int_equal(asked_run("table --plan plan.json --shard 2/3 -o out"), RG_EXIT_FAIL);
    asked_left_out = RG_EXIT_PASS;
    asked_expect("table --plan plan.json -o out", "memory 0; ", RG_EXIT_USAGE);
    struct rg_farm_plan plan = {0};
    assert_true(rg_farm_plan_read(&plan, "plan.json"));
    strcpy(plan.commit, "0123");
    assert_true(rg_farm_plan_write(&plan, "plan.json"));
    rg_farm_plan_free(&plan);
    char due[256];
    asked_expect("table --plan plan.json --shard 2/3 -o out", "memory 0; ", RG_EXIT_USAGE);
    snprintf(due, sizeof(due),
             "plan.json: is of commit 0123, and this raingauge of %s; plan anew, or "
             "measure with that one",
             rg_build_commit);
    assert_string_equal(asked_logged, due);
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(plans_are_asked_for),
        ASKED(what_is_missing_is_printed),
        ASKED(merges_are_asked_for),
        ASKED(shards_are_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
