// Baselines: what is asked for, what is kept, and what is not replaced.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/gate/baseline/baseline.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/record/passport/key.h"
#include "tests/harness/cli/asked.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

static enum rg_outcome ends[4];    // of two cells on two devices
static bool can_be_made, is_raced; // `raced`: another writes the file meanwhile
static struct rg_baseline_making how;
static int changes;

static void add_row(struct rg_baseline *made, int i)
{
    struct rg_baseline_row *row = rg_baseline_add(made);
    snprintf(row->cell, sizeof(row->cell), "a/%s", i % 2 ? "two" : "one");
    snprintf(row->device, sizeof(row->device), "%s", asked_devices[i / 2].info.name);
    row->outcome = ends[i];
    snprintf(row->why, sizeof(row->why), "it ended");
    row->launches.count = i < 2 ? 3 : 0; // nothing is timed on the second device
    for (int k = 0; k < row->launches.count; k++)
        row->launches.ms[k] = 10 + i;
}

bool rg_baseline_make(const struct rg_baseline_request *request, struct rg_devices *devices,
                      struct rg_baseline *made, struct rg_baseline_making *making)
{
    asked_note("%d cells, %d launches", (int)request->cells->count, request->launches);
    *making = how;
    for (int d = 0; d < devices->count; d++) {
        struct rg_baseline_device *device = &made->devices[made->device_count++];
        snprintf(device->name, sizeof(device->name), "%s", devices->devices[d]->info.name);
        device->parts = json_pack("{ss}", "driver", devices->devices[d]->info.driver);
    }
    for (int i = 0; i < 4; i++)
        add_row(made, i);
    return can_be_made || rg_error("stop");
}

bool rg_baseline_read(struct rg_baseline *baseline, const char *path)
{
    (void)baseline;
    asked_note("read %s; ", path);
    return true;
}

bool rg_baseline_write(const struct rg_baseline *baseline, const char *path)
{
    asked_note("; write %d rows to %s", (int)baseline->count, path);
    return true;
}

int rg_baseline_print_changes(const struct rg_baseline *then, const struct rg_baseline *now,
                              FILE *out)
{
    (void)then;
    (void)now;
    FILE *file = is_raced ? fopen("b.json", "a") : NULL;
    if (file)
        fputs("more", file);
    if (file)
        fclose(file);
    fprintf(out, "changes\n");
    return changes;
}

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static int setup(void **state)
{
    const int failed = asked_setup(state);
    memset(ends, 0, sizeof(ends));
    can_be_made = true;
    how = (struct rg_baseline_making){0};
    is_raced = false;
    changes = 0;
    write_file("cells.txt", "a/one raster 16x16 1\na/two raster 16x16 1\n");
    return failed;
}

// --- baselines ---

#define MADE   "baseline --cells cells.txt -o b.json"
#define OPENED "open all, require -, 120 s; "

static void baselines_are_asked_for(void **state)
{
    (void)state;
    can_be_made = false;
    asked_expect(MADE, "memory 0; " OPENED "2 cells, 24 launches", RG_EXIT_USAGE);
    asked_expect(MADE " --launches 9 --device cpu,gl --require gl --timeout 6 --memory 1K",
                 "memory 1024; open cpu,gl, require gl, 6 s; 2 cells, 9 launches", RG_EXIT_USAGE);
    asked_expect(MADE " --pictures", "memory 0; " OPENED "2 cells, 0 launches", RG_EXIT_USAGE);
    asked_opening = RG_EXIT_UNSUPPORTED;
    asked_expect(MADE, "memory 0; " OPENED, RG_EXIT_UNSUPPORTED);
    asked_expect("baseline --cells cells.txt", "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "baseline: name the file to write, as in `raingauge baseline "
                                      "-o results/baseline.json`");
}

// The keys of the devices, with how much their launches scatter if there are any.
static const char *keys(void)
{
    static char text[256];
    char first[RG_KEY_SIZE], second[RG_KEY_SIZE];
    json_t *parts = json_pack("{ss}", "driver", "1.0");
    rg_key_hash(parts, first);
    json_object_set_new(parts, "driver", json_string("2.0"));
    rg_key_hash(parts, second);
    json_decref(parts);
    snprintf(text, sizeof(text), "first: key %s; a launch scatters by 0.0 %%\nsecond: key %s\n",
             first, second);
    return text;
}

static void expect_printed(const char *rest)
{
    char due[1024];
    snprintf(due, sizeof(due), "%s%s", keys(), rest);
    assert_string_equal(asked_printed, due);
}

static void a_first_baseline_is_written(void **state)
{
    (void)state;
    asked_expect(MADE, "memory 0; " OPENED "2 cells, 24 launches; write 4 rows to b.json",
                 RG_EXIT_PASS);
    expect_printed("b.json: 2 cells on 2 devices\n");
    ends[1] = RG_CRASH;
    ends[2] = RG_UNSUPPORTED;
    assert_int_equal(asked_run(MADE), RG_EXIT_FAIL);
    expect_printed("a/two.first: crash: it ended\na/one.second: unsupported: it ended\n"
                   "b.json: 2 cells on 2 devices\n");
    assert_non_null(strstr(asked_seen, "; write 4 rows"));
    ends[1] = RG_OK;
    assert_int_equal(asked_run(MADE), RG_EXIT_PASS);
    how.has_failed = true;
    assert_int_equal(asked_run(MADE), RG_EXIT_FAIL);
}

// A failure of raingauge itself is expected of no device.
static void lacks_are_not_kept(void **state)
{
    (void)state;
    ends[3] = RG_LACKING;
    asked_expect(MADE, "memory 0; " OPENED "2 cells, 24 launches", RG_EXIT_HARNESS);
    expect_printed("a/two.second: error: it ended\n");
    assert_non_null(strstr(asked_logged, "b.json: stays as it is, for raingauge itself lacked"));
    ends[3] = RG_OK; // nor are lacks of fixed functions, which have no rows
    how.is_lacking = true;
    asked_expect(MADE, "memory 0; " OPENED "2 cells, 24 launches", RG_EXIT_HARNESS);
    assert_non_null(strstr(asked_logged, "b.json: stays as it is, for raingauge itself lacked"));
}

// A file that differs is written by --update alone, and only as it was before the work.
static void baselines_are_replaced_on_request(void **state)
{
    (void)state;
    const char *const seen = "memory 0; read b.json; " OPENED "2 cells, 24 launches";
    const char *const written =
        "memory 0; read b.json; " OPENED "2 cells, 24 launches; write 4 rows to b.json";
    write_file("b.json", "old");
    asked_expect(MADE, seen, RG_EXIT_PASS);
    expect_printed("changes\nb.json: nothing changes\n");
    changes = 1;
    asked_expect(MADE, seen, RG_EXIT_FAIL);
    expect_printed("changes\nb.json: 1 change; it is as it was: --update writes them\n");
    changes = 2;
    asked_expect(MADE, seen, RG_EXIT_FAIL);
    expect_printed("changes\nb.json: 2 changes; it is as it was: --update writes them\n");
    asked_expect(MADE " --update", written, RG_EXIT_PASS);
    expect_printed("changes\nb.json: 2 cells on 2 devices\n");
    asked_left_out = RG_EXIT_FAIL;
    asked_expect(MADE " --update", seen, RG_EXIT_FAIL);
    assert_non_null(strstr(asked_logged, "b.json: stays as it is, for it would lose what it has"));
    asked_left_out = RG_EXIT_PASS;
    is_raced = true;
    asked_expect(MADE " --update", seen, RG_EXIT_FAIL);
    assert_non_null(strstr(asked_logged, "b.json: was written by another meanwhile, and stays so"));
    assert_int_equal(unlink("b.json"), 0);
    asked_expect(MADE, "memory 0; " OPENED "2 cells, 24 launches; write 4 rows to b.json",
                 RG_EXIT_PASS);
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(baselines_are_asked_for),
        ASKED(a_first_baseline_is_written),
        ASKED(lacks_are_not_kept),
        ASKED(baselines_are_replaced_on_request),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
