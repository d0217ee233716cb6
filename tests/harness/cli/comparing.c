// What the commands that compare devices ask for, by each of their options.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "harness/compare/diff/devices.h"
#include "harness/compare/diff/files.h"
#include "harness/compare/gate/run/gate.h"
#include "harness/compare/verify/course.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/devices/workers/worker.h"
#include "tests/harness/cli/asked.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

int rg_diff_devices(const struct rg_diff_devices_request *r)
{
    asked_note_subject(&r->subject);
    asked_note(", frame %d on %s, require %s, %d s, heat %s, exposure %g%s%s", r->frames,
               r->devices->names, asked_text(r->devices->require), r->devices->timeout_s,
               asked_text(r->heatmap_prefix), r->exposure, r->mutants ? ", mutants" : "",
               r->json ? ", json" : "");
    return RG_EXIT_FAIL;
}

int rg_diff_files(const struct rg_diff_request *r)
{
    asked_note("%s and %s, background %s, heat %s, exposure %g%s", r->a, r->b,
               asked_text(r->background), asked_text(r->heatmap_prefix),
               (double)r->options.exposure, r->json ? ", json" : "");
    return RG_EXIT_FAIL;
}

int rg_gate_run(const struct rg_gate_request *r, struct rg_gate *gate)
{
    (void)gate;
    for (int i = 0; i < r->pairs->count; i++)
        asked_note("%s > %s, ", r->pairs->all[i].names[RG_SIDE_A],
                   r->pairs->all[i].names[RG_SIDE_B]);
    asked_note("%d cells, margin %g, %g s%s%s, filter %s, shard %d/%d%s, pictures %s, folder %s%s, "
               "require %s, %d s",
               (int)r->cells->count, r->margin, r->budget_s, r->pictures_only ? ", pictures" : "",
               r->strict ? ", strict" : "", asked_text(r->filter), r->shard.number, r->shard.count,
               r->is_apart ? " apart" : "", asked_text(r->pictures), asked_text(r->folder),
               r->fresh ? ", fresh" : "", asked_text(r->require), rg_workers.timeout_s);
    for (int i = 0; i < r->left.count; i++)
        asked_note(", without %s", r->left.names[i]);
    return RG_EXIT_INCONCLUSIVE;
}

static bool has_fixed; // a gate compares fixed functions

bool rg_gate_has_fixed(const struct rg_baseline *baseline, const struct rg_gate_pair *pair)
{
    (void)baseline;
    return has_fixed && strcmp(pair->names[RG_SIDE_B], "cpu") != 0; // of the second device
}

static int timed[2]; // launches of the baseline's devices
static const char *device_names[2];

bool rg_baseline_read(struct rg_baseline *baseline, const char *path)
{
    asked_note("read %s; ", path);
    for (int i = 0; i < 2; i++) {
        struct rg_baseline_row *row = rg_baseline_add(baseline);
        snprintf(row->device, sizeof(row->device), "%s", device_names[i]);
        row->launches.count = timed[i];
        snprintf(baseline->devices[i].name, sizeof(baseline->devices[i].name), "%s",
                 device_names[i]);
    }
    baseline->device_count = 2;
    return true;
}

bool rg_baseline_fits(const struct rg_baseline *baseline, const char *path,
                      const struct rg_gate_cells *cells, const char *cells_name,
                      const char *devices)
{
    (void)baseline;
    (void)path;
    asked_note("%d of %s on %s; ", (int)cells->count, cells_name, asked_text(devices));
    return true;
}

struct rg_device *rg_devices_open_one(const char *name)
{
    asked_note("open %s; ", name);
    return &asked_devices[!strcmp(name, "cpu")];
}

bool rg_device_close(struct rg_device *device)
{
    asked_note(device ? "close one; " : "");
    return true;
}

bool rg_verify_choose(struct rg_verify_course *course, const struct rg_shard *shard)
{
    (void)course;
    asked_note("shard %d/%d; ", shard->number, shard->count);
    return true;
}

void rg_verify_run_all(const struct rg_verify_course *c)
{
    static const char *const lengths[] = {"usual", "quick", "full"};
    for (int i = 0; i < c->count && i < 2; i++)
        asked_note_subject(&(struct rg_subject){c->subjects[i].technique, c->subjects[i].settings,
                                                c->verify.width, c->verify.height});
    asked_note(", %d in all, %s, %d steps%s, %s held against %s, mutants on %s; ", c->count,
               lengths[c->verify.length], c->verify.steps, c->stages ? ", stages" : "",
               c->devices->devices[1]->info.name, c->verify.reference->info.name,
               c->verify.mutant_device->info.name);
}

// --- diff and gate ---

static void differences_are_asked_for(void **state)
{
    (void)state;
    static const struct {
        const char *line, *seen;
    } rows[] = {
        {"diff flow", "memory 0; flow seed 1, 512x512, frame 60 on all, require -, 120 s, heat -, "
                      "exposure 1"},
        {"diff flow --set seed=4 --frame 3 --size 8x4 --device gl,cpu --require gl --timeout 9 "
         "--mutants --json --exposure 2 --memory 1K -o heat",
         "memory 1024; flow seed 4, 8x4, frame 3 on gl,cpu, require gl, 9 s, heat heat, exposure "
         "2, "
         "mutants, json"},
        {"diff raster --json",
         "memory 0; raster seed 1, 512x512, frame 60 on all, require -, 120 s, "
         "heat -, exposure 1, json"},
        {"diff raster --mutants",
         "memory 0; raster seed 1, 512x512, frame 60 on all, require -, 120 "
         "s, heat -, exposure 1, mutants"},
        {"diff a.png b.png", "memory 0; a.png and b.png, background -, heat -, exposure 1"},
        {"diff a.png b.png --background c.png -o heat --exposure 0.5 --json",
         "memory 0; a.png and b.png, background c.png, heat heat, exposure 0.5, json"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        asked_expect(rows[i].line, rows[i].seen, RG_EXIT_FAIL);
}

static void write_cells(void)
{
    FILE *file = fopen("cells.txt", "w");
    assert_non_null(file);
    fputs("a/one raster 16x16 1\na/two raster 16x16 1\n", file);
    assert_int_equal(fclose(file), 0);
}

#define PAIR "memory 0; cpu > cpu:reference, 2 cells, "

static void gates_are_asked_for(void **state)
{
    (void)state;
    static const struct {
        const char *line, *seen;
    } rows[] = {
        {"gate cpu cpu:reference --cells cells.txt", PAIR
         "margin 0.05, 0 s, filter -, shard 1/1 apart, pictures -, folder -, require -, 120 s"},
        {"gate cpu cpu:reference --cells cells.txt --margin 7 --budget 90s --strict --fresh "
         "--require "
         "gl --timeout 6 -o out",
         PAIR "margin 0.07, 90 s, strict, filter -, shard 1/1 apart, pictures out, folder out, "
              "fresh, require gl, 6 s"},
        {"gate cpu cpu:reference --cells cells.txt --pictures --junit report.xml",
         PAIR "margin 0.05, 0 s, pictures, filter -, shard 1/1 apart, pictures report-pictures, "
              "folder -, require -, 120 s"},
        {"gate cpu cpu:reference --cells cells.txt --shard 2/3 -o out",
         PAIR "margin 0.05, 0 s, filter -, shard 2/3, pictures out, folder out/2-of-3, require -, "
              "120 s"},
        {"gate cpu cpu:reference --cells cells.txt --gtest_filter=a* --gtest_output=xml:folder/",
         PAIR "margin 0.05, 0 s, filter a*, shard 1/1 apart, pictures folder/raingauge-pictures, "
              "folder -, require -, 120 s"},
        {"gate cpu cpu:reference --cells cells.txt --memory 1K",
         "memory 1024; cpu > cpu:reference, 2 cells, margin 0.05, 0 s, filter -, shard 1/1 apart, "
         "pictures -, folder -, require -, 120 s"},
    };
    write_cells();
    has_fixed = true;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        asked_expect(rows[i].line, rows[i].seen, RG_EXIT_INCONCLUSIVE);
    setenv("GTEST_TOTAL_SHARDS", "4", 1);
    setenv("GTEST_SHARD_INDEX", "2", 1);
    asked_expect("gate cpu cpu:reference --cells cells.txt",
                 PAIR
                 "margin 0.05, 0 s, filter -, shard 3/4 apart, pictures -, folder -, require -, "
                 "120 s",
                 RG_EXIT_INCONCLUSIVE);
    unsetenv("GTEST_TOTAL_SHARDS");
    unsetenv("GTEST_SHARD_INDEX");
    asked_run("gate cpu cpu:reference --cells cells.txt --gtest_list_tests");
    assert_int_equal(strncmp(asked_printed, "a_one.\n  cpu_reference_", 23), 0);
    assert_non_null(strstr(asked_printed, "\na_two.\n  cpu_reference_"));
}

// Each device of the baseline that is asked for is judged, and the others are named.
static void baselines_are_held_against(void **state)
{
    (void)state;
    const char *const rest = ", 0 s, filter -, shard 1/1 apart, pictures -, folder -, require -, "
                             "120 s";
    char seen[512];
    write_cells();
    FILE *file = fopen("b.json", "w");
    assert_non_null(file);
    assert_int_equal(fclose(file), 0);
    device_names[0] = "cpu";
    device_names[1] = "cpu:reference";
    timed[0] = timed[1] = 9;
    snprintf(seen, sizeof(seen),
             "memory 0; read b.json; 2 of cells.txt on -;  > cpu,  > cpu:reference, 2 "
             "cells, margin 0.1%s",
             rest);
    asked_expect("gate --baseline b.json --cells cells.txt", seen, RG_EXIT_INCONCLUSIVE);
    snprintf(seen, sizeof(seen),
             "memory 0; read b.json; 2 of cells.txt on cpu:reference;  > cpu:reference, 2 cells, "
             "margin 0.02%s, without cpu",
             rest);
    asked_expect("gate --baseline b.json --cells cells.txt --device cpu:reference --margin 2", seen,
                 RG_EXIT_INCONCLUSIVE);
    asked_run("gate --baseline b.json --cells cells.txt --device cpu");
    assert_non_null(strstr(asked_seen, "120 s, without cpu:reference"));
    has_fixed = true;
    asked_run("gate --baseline b.json --cells cells.txt --strict");
    assert_non_null(strstr(asked_seen, "margin 0.1, 0 s, strict, filter"));
    assert_int_equal(asked_run("gate --baseline b.json --cells cells.txt --strict --device cpu"),
                     RG_EXIT_USAGE);
    assert_non_null(strstr(asked_logged, "--strict: is about fixed functions, and this gate"));
    timed[1] = 0; // one of the two has times
    assert_int_equal(asked_run("gate --baseline b.json --cells cells.txt"), RG_EXIT_INCONCLUSIVE);
    assert_int_equal(asked_run("gate --baseline b.json --cells cells.txt --device cpu:reference"),
                     RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "b.json: has no times of what is asked; give --pictures, or "
                                      "make it anew without that");
    assert_int_equal(
        asked_run("gate --baseline b.json --cells cells.txt --device cpu:reference --pictures"),
        RG_EXIT_INCONCLUSIVE);
    device_names[1] = "new";
    assert_int_equal(asked_run("gate --baseline b.json --cells cells.txt"), RG_EXIT_USAGE);
    assert_string_equal(asked_logged,
                        "b.json: its device 'new' is a short name, and the file does "
                        "not say of what; add --device new=DEVICE with all that are to "
                        "run");
}

static void gates_without_a_meaning_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *line, *logged;
    } rows[] = {
        {"gate cpu", "gate: name two devices, the one that B is held against first"},
        {"gate", "gate: name two devices"},
        {"gate cpu gl --against old", "gate: 'cpu' is a device of a pair, and --against has pairs"},
        {"gate cpu --baseline b.json", "gate: 'cpu' is a device of a pair, and --baseline has"},
        {"gate cpu gl --device cpu", "gate: --device is of --against and --baseline; name two"},
        {"gate cpu cpu:reference --partial",
         "--partial: is about the records of shards; name them"},
        {"gate cpu cpu:reference --times t.json", "--times: divides the cells among shards; add"},
        {"gate cpu cpu:reference --shard 1/2",
         "--shard: name the folder of its record, as -o gate"},
        {"gate cpu cpu:reference --strict",
         "--strict: is about fixed functions, and this gate compares none; name two drivers"},
        {"gate cpu cpu:reference --update", "--update: there is no file to write; name one by"},
        {"gate cpu gl --from here", "--from: the shards had their devices; leave out 'cpu'"},
    };
    has_fixed = false;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        assert_int_equal(asked_run(rows[i].line), RG_EXIT_USAGE);
        if (strncmp(asked_logged, rows[i].logged, strlen(rows[i].logged)) != 0)
            fail_msg("%s: '%s'", rows[i].line, asked_logged);
        assert_null(strstr(asked_seen, " > "));
    }
}

// --- verify ---

#define OPENED "open cpu:reference; open cpu; shard 1/1; "
#define CLOSED "second held against first, mutants on second; close one; close one; close 2"

static void verifying_is_asked_for(void **state)
{
    (void)state;
    static const struct {
        const char *line, *seen;
    } rows[] = {
        {"verify raster --device gl",
         "memory 0; open gl, require -, 120 s; " OPENED "raster seed 1, "
         "512x512, 1 in all, usual, -1 steps, " CLOSED},
        {"verify flow --set seed=3 --quick --frame 7 --size 8x4 --require gl --timeout 8",
         "memory 0; open all, require gl, 8 s; " OPENED
         "flow seed 3, 8x4, 1 in all, quick, 7 steps, " CLOSED},
        {"verify raster flow --full --memory 2K",
         "memory 2048; open all, require -, 120 s; " OPENED "raster seed 1, 512x512flow seed 1, "
         "512x512, 2 in all, full, -1 steps, " CLOSED},
        {"verify flow --stages", "memory 0; open all, require -, 120 s; " OPENED "flow seed 1, "
                                 "512x512, 1 in all, usual, 3 steps, stages, " CLOSED},
        {"verify flow --stages --frame 5",
         "memory 0; open all, require -, 120 s; " OPENED "flow seed "
         "1, 512x512, 1 in all, usual, 5 steps, stages, " CLOSED},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        asked_expect(rows[i].line, rows[i].seen, RG_EXIT_NOTHING); // no unit was checked
    int techniques = 0;
    while (rg_techniques[techniques])
        techniques++;
    char all[64];
    snprintf(all, sizeof(all), ", %d in all, usual", techniques);
    asked_run("verify");
    assert_non_null(strstr(asked_seen, all));
    asked_run("verify raster --shard 2/3 -o out");
    assert_non_null(strstr(asked_seen, "shard 2/3; "));
}

// Devices that are opened anyway are not opened a second time, by whole names.
static void devices_are_opened_once(void **state)
{
    (void)state;
    strcpy(asked_devices[0].info.name, "cpu:reference");
    asked_run("verify raster");
    assert_null(strstr(asked_seen, "open cpu:reference; "));
    assert_non_null(strstr(asked_seen, "open cpu; "));
    strcpy(asked_devices[1].info.name, "cpu");
    asked_run("verify raster");
    assert_null(strstr(asked_seen, "open cpu; "));
    assert_non_null(strstr(asked_seen, "cpu held against cpu:reference, mutants on cpu; "));
    strcpy(asked_devices[0].info.name, "first");
    strcpy(asked_devices[1].info.name, "second");
}

// A shard's record says what was divided, and how it ended, closing included.
static void shards_leave_a_record(void **state)
{
    (void)state;
    asked_closing = RG_EXIT_HARNESS;
    asked_run("verify raster --set seed=5 --full --frame 7 --size 8x4 --stages --shard 2/3 -o out");
    json_t *json = json_load_file("out/verify-2-of-3.json", 0, NULL);
    assert_non_null(json);
    assert_int_equal(json_integer_value(json_object_get(json, "exit")), RG_EXIT_HARNESS);
    assert_string_equal(json_string_value(json_object_get(json, "note")),
                        "first: 1.0\nsecond: 2.0\n");
    const json_t *of = json_object_get(json_object_get(json, "shard"), "of");
    json_t *due = json_pack("{s[s] sb sb si si si sb}", "set", "seed=5", "quick", 0, "full", 1,
                            "frame", 7, "width", 8, "height", 4, "stages", 1);
    assert_true(json_equal(json_object_get(of, "options"), due));
    json_decref(due);
    json_decref(json);
}

static void verifying_without_a_meaning_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *line, *logged;
    } rows[] = {
        {"verify --partial", "--partial: is about the records of shards; name them by --from, or "
                             "leave it out"},
        {"verify -o out", "-o out: is for the record of a shard; add --shard, or leave it out"},
        {"verify --shard 1/2", "--shard: name the folder of its record, as -o verified, which all "
                               "shards share"},
        {"verify raster --from here",
         "--from: the shards had their techniques; leave out 'raster'"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        asked_expect(rows[i].line, "memory 0; ", RG_EXIT_USAGE);
        assert_string_equal(asked_logged, rows[i].logged);
    }
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, asked_setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(differences_are_asked_for),  ASKED(gates_are_asked_for),
        ASKED(baselines_are_held_against), ASKED(gates_without_a_meaning_are_refused),
        ASKED(verifying_is_asked_for),     ASKED(devices_are_opened_once),
        ASKED(shards_leave_a_record),      ASKED(verifying_without_a_meaning_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
