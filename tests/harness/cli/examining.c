// What doctor examines, and what lists hold.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "harness/compare/doctor/compile.h"
#include "harness/compare/doctor/doctor.h"
#include "harness/compare/doctor/fixed.h"
#include "harness/compare/doctor/prologue.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/devices/workers/worker.h"
#include "harness/tables/papers/papers.h"
#include "tests/harness/cli/asked.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

static enum rg_outcome missing; // of the backend that has no device

void rg_devices_list(struct rg_device_list *list)
{
    *list = (struct rg_device_list){.count = 2, .missing_count = missing != RG_OK};
    for (int i = 0; i < 2; i++)
        list->infos[i] = asked_devices[i].info;
    list->missing[0].outcome = missing;
    snprintf(list->missing[0].why, sizeof(list->missing[0].why), "vulkan: it fell");
}

// A device ends as its name says.
void rg_doctor_examine(struct rg_examination *e)
{
    asked_note("%s; ", e->info.name);
    e->status = !strcmp(e->info.name, "gl")       ? RG_FAIL
                : !strcmp(e->info.name, "vulkan") ? RG_UNSUPPORTED
                                                  : RG_OK;
    snprintf(e->why, sizeof(e->why), "2 operations differ");
    e->is_unknown = !strcmp(e->info.name, "cpu:7");
    if (e->is_unknown)
        rg_error("device 'cpu:7': unknown");
    e->opened = e->status != RG_UNSUPPORTED;
}

// The passport has the devices that were opened, in their order.
static void note_report(const struct rg_doctor_report *report, const char *form)
{
    const json_t *devices = json_object_get(report->passport, "devices");
    size_t opened = 0;
    for (int i = 0; i < report->count; i++)
        if (report->examinations[i].opened) {
            const json_t *device = json_array_get(devices, opened++);
            assert_string_equal(json_string_value(json_object_get(device, "name")),
                                report->examinations[i].info.name);
        }
    assert_int_equal(json_array_size(devices), opened);
    asked_note("%s of %d, %zu opened, %zu warnings", form, report->count, opened,
               json_array_size(report->warnings));
}

json_t *rg_doctor_warnings(const struct rg_device_list *list)
{
    return json_pack("[i]", list->count);
}

void rg_doctor_print_text(const struct rg_doctor_report *report)
{
    note_report(report, "text");
}

void rg_doctor_print_json(const struct rg_doctor_report *report)
{
    note_report(report, "json");
}

bool rg_doctor_knows_kernels(const char *names)
{
    return strcmp(names, "none") || rg_error("no such kernel");
}

int rg_doctor_compile(const char *device, const char *names, json_t *report)
{
    asked_note("compile %s on %s%s; ", names, device, report ? " as json" : "");
    if (report)
        json_array_append_new(report, json_string(device));
    return strcmp(device, "second") ? RG_EXIT_PASS : RG_EXIT_FAIL;
}

int rg_doctor_fixed(const char *name, struct rg_device_info *info, json_t *devices)
{
    asked_note("draw on %s; ", name);
    snprintf(info->name, sizeof(info->name), "%s", name);
    json_array_append_new(devices, json_string(name));
    return !strcmp(name, "gl") ? RG_EXIT_FAIL : strcmp(name, "vulkan") ? 0 : RG_EXIT_UNSUPPORTED;
}

json_t *rg_doctor_fixed_passport(const json_t *devices, const struct rg_device_info *infos,
                                 int count)
{
    asked_note("passport of %s to %s", infos[0].name, infos[count - 1].name);
    return json_integer((json_int_t)json_array_size(devices));
}

void rg_doctor_fixed_print(const json_t *devices)
{
    asked_note("print %zu", json_array_size(devices));
}

static bool begins, ends_well;

bool rg_prologue_begin(struct rg_prologue *prologue)
{
    assert_true(prologue->watch && !*prologue->root);
    asked_note("begin; ");
    return begins;
}

bool rg_prologue_end(const struct rg_prologue *prologue)
{
    (void)prologue;
    asked_note("end");
    return ends_well;
}

// --- doctor ---

// A failure outweighs what is unsupported, and a driver that fell as it was listed counts with all.
static const struct {
    const char *line, *seen;
    enum rg_outcome missing;
    int exit;
} examinations[] = {
    {"doctor", "memory 0; first; second; text of 2, 2 opened, 1 warnings", RG_OK, 0},
    {"doctor --json --memory 1K", "memory 1024; first; second; json of 2, 2 opened, 1 warnings",
     RG_UNSUPPORTED, 0},
    {"doctor", "memory 0; first; second; text of 2, 2 opened, 1 warnings", RG_CRASH, RG_EXIT_FAIL},
    {"doctor --device cpu", "memory 0; cpu; text of 1, 1 opened, 1 warnings", RG_CRASH, 0},
    {"doctor --device cpu,vulkan", "memory 0; cpu; vulkan; text of 2, 1 opened, 1 warnings", RG_OK,
     RG_EXIT_UNSUPPORTED},
    {"doctor --device gl,vulkan", "memory 0; gl; vulkan; text of 2, 1 opened, 1 warnings", RG_OK,
     RG_EXIT_FAIL},
    {"doctor --device cpu:7,cpu", "memory 0; cpu:7; ", RG_OK, RG_EXIT_USAGE},
    {"doctor --kernels a,b --device first", "memory 0; compile a,b on first; ", RG_OK,
     RG_EXIT_PASS},
    {"doctor --kernels all --json",
     "memory 0; compile all on first as json; compile all on second as json; ", RG_OK,
     RG_EXIT_FAIL},
    {"doctor --kernels a --device first", "memory 0; compile a on first; ", RG_CRASH, RG_EXIT_PASS},
    {"doctor --kernels none", "memory 0; ", RG_OK, RG_EXIT_USAGE},
    {"doctor --fixed-function", "memory 0; draw on first; draw on second; print 2", RG_OK, 0},
    {"doctor --fixed-function --device cpu,vulkan --json",
     "memory 0; draw on cpu; draw on vulkan; passport of cpu to vulkan", RG_OK, 0},
    {"doctor --fixed-function --device vulkan", "memory 0; draw on vulkan; print 1", RG_OK,
     RG_EXIT_UNSUPPORTED},
    {"doctor --fixed-function --device gl,vulkan", "memory 0; draw on gl; draw on vulkan; print 2",
     RG_OK, RG_EXIT_FAIL},
    {"doctor --fixed-function", "memory 0; draw on first; draw on second; print 2", RG_TIMEOUT,
     RG_EXIT_FAIL},
};

static void examinations_are_asked_for(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(examinations) / sizeof(examinations[0]); i++) {
        missing = examinations[i].missing;
        asked_expect(examinations[i].line, examinations[i].seen, examinations[i].exit);
    }
    static const char *const all[] = {"doctor", "doctor --kernels a", "doctor --fixed-function"};
    missing = RG_CRASH;
    for (int i = 0; i < 3; i++) { // a driver that falls as it is listed is told
        assert_int_equal(asked_run(all[i]), RG_EXIT_FAIL);
        assert_string_equal(asked_logged, "vulkan: it fell");
    }
    missing = RG_OK;
    asked_run("doctor --kernels a --json");
    assert_string_equal(asked_printed, "[\n  \"first\",\n  \"second\"\n]\n");
    asked_run("doctor --fixed-function --json --device cpu");
    assert_string_equal(asked_printed, "{\n  \"format\": 1,\n  \"passport\": 1,\n  "
                                       "\"fixed_functions\": [\n    \"cpu\"\n  ]\n}\n");
    asked_run("doctor --device gl --timeout 3");
    assert_string_equal(asked_logged, "device 'gl': 2 operations differ");
    assert_int_equal(rg_workers.timeout_s, 3);
}

static void so_many_devices_are_examined(void **state)
{
    (void)state;
    char line[256] = "doctor --device cpu";
    for (int i = 1; i < RG_MAX_DEVICES; i++)
        strcat(line, ",cpu");
    assert_int_equal(asked_run(line), RG_EXIT_PASS);
    assert_non_null(strstr(asked_seen, "text of 32, 32 opened"));
    strcat(line, ",cpu");
    asked_expect(line, "memory 0; ", RG_EXIT_USAGE);
    assert_string_equal(asked_logged, "--device: more than 32 names");
}

// A device that was listed and cannot be opened any more fails, and the others are examined.
static void devices_that_are_gone_are_told(void **state)
{
    (void)state;
    strcpy(asked_devices[0].info.name, "cpu:7");
    assert_int_not_equal(asked_run("doctor"), RG_EXIT_USAGE);
    assert_non_null(strstr(asked_seen, "cpu:7; second; text of 2"));
    strcpy(asked_devices[0].info.name, "first");
}

// Only a machine that is well and idle takes cells; a device that is not there is no reason to try
// again later.
static void prologues_are_asked_for(void **state)
{
    (void)state;
    static const struct {
        const char *device, *seen;
        bool begins, ends_well;
        int exit;
    } rows[] = {{"cpu", "memory 0; begin; cpu; end", true, true, RG_EXIT_PASS},
                {"cpu", "memory 0; begin; cpu; end", true, false, RG_EXIT_LATER},
                {"cpu", "memory 0; begin; ", false, true, RG_EXIT_LATER},
                {"gl", "memory 0; begin; gl; ", true, true, RG_EXIT_LATER},
                {"vulkan", "memory 0; begin; vulkan; ", true, true, RG_EXIT_UNSUPPORTED},
                {"cpu:7", "memory 0; begin; cpu:7; ", true, true, RG_EXIT_USAGE}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char line[64];
        begins = rows[i].begins;
        ends_well = rows[i].ends_well;
        snprintf(line, sizeof(line), "doctor --prologue --device %s", rows[i].device);
        asked_expect(line, rows[i].seen, rows[i].exit);
    }
}

// --- lists ---

// Columns are as wide as their widest text, and two blanks apart.
static void lists_have_columns(void **state)
{
    (void)state;
    asked_expect("list devices --timeout 8 --memory 1K", "memory 1024; ", RG_EXIT_PASS);
    assert_string_equal(asked_printed, "first     one  1.0\nsecond    two  2.0\n");
    assert_int_equal(rg_workers.timeout_s, 8);
    missing = RG_CRASH;
    assert_int_equal(asked_run("list devices"), RG_EXIT_FAIL);
    missing = RG_OK;
    static char due[1 << 14];
    size_t widest = 0, used = 0;
    for (int i = 0; rg_tables[i]; i++)
        widest = strlen(rg_tables[i]->id) > widest ? strlen(rg_tables[i]->id) : widest;
    for (int i = 0; rg_tables[i]; i++)
        used += (size_t)snprintf(due + used, sizeof(due) - used, "%-*s  %s\n", (int)widest,
                                 rg_tables[i]->id, rg_tables[i]->about);
    assert_int_equal(asked_run("list tables"), RG_EXIT_PASS);
    assert_string_equal(asked_printed, due);
}

static void expect_row(const char *line, const char *list, int number, const char *name,
                       const char *other, const char *text)
{
    asked_run(line);
    json_t *json = json_loads(asked_printed, 0, NULL);
    const json_t *row = json_array_get(json_object_get(json, list), (size_t)number);
    assert_string_equal(json_string_value(json_object_get(row, "name")), name);
    assert_string_equal(json_string_value(json_object_get(row, other)), text);
    json_decref(json);
}

static void lists_are_json_on_request(void **state)
{
    (void)state;
    expect_row("list tables --json", "tables", 1, rg_tables[1]->id, "technique",
               rg_tables[1]->technique);
    expect_row("list techniques --json", "techniques", 1, rg_techniques[1]->name, "paper",
               rg_techniques[1]->paper);
    expect_row("list devices --json", "devices", 1, "second", "driver", "2.0");
    expect_row("list devices --json", "devices", 0, "first", "device", "one");
    const struct rg_param *rows = rg_techniques[1]->params->rows;
    char line[64];
    snprintf(line, sizeof(line), "list params %s --json", rg_techniques[1]->name);
    expect_row(line, "params", 0, rows[0].name, "about", rows[0].about);
    expect_row("list params flow --json", "params", 0,
               rg_technique_find("flow")->params->rows[0].name, "unit",
               rg_technique_find("flow")->params->rows[0].unit);
    for (int i = 0; i < rg_technique_find("flow")->params->count; i++) {
        const struct rg_param *p = &rg_technique_find("flow")->params->rows[i];
        char range[128];
        snprintf(range, sizeof(range), "%.10g to %.10g", p->min, p->max);
        expect_row("list params flow --json", "params", i, p->name, "range",
                   p->kind == RG_PARAM_CHOICE ? p->text
                   : p->kind == RG_PARAM_FILE ? "path or name"
                                              : range);
    }
}

#define ASKED(test) cmocka_unit_test_setup_teardown(test, asked_setup, asked_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        ASKED(examinations_are_asked_for),
        ASKED(so_many_devices_are_examined),
        ASKED(devices_that_are_gone_are_told),
        ASKED(prologues_are_asked_for),
        ASKED(lists_have_columns),
        ASKED(lists_are_json_on_request),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
