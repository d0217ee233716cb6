// raingauge doctor: reports how far this machine and its drivers can be trusted.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/compare/doctor/compile.h"
#include "harness/compare/doctor/doctor.h"
#include "harness/compare/doctor/fixed.h"
#include "harness/compare/doctor/prologue.h"
#include "harness/devices/devices.h"
#include "harness/devices/names.h"
#include "harness/record/passport/passport.h"
#include "harness/devices/workers/worker.h"

struct doctor_options {
    char *devices; // their names
    char *kernels; // to compile; NULL: devices are examined
    int timeout_s;
    int64_t memory_bytes;
    bool fixed_function;
    bool json, prologue;
};

#define AT(field) offsetof(struct doctor_options, field)

static const struct rg_option options[] = {
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices), "all"),
    RG_INCLUDE(rg_timeout_option, AT(timeout_s), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    {RG_OPTION_TEXT, "kernels", .argument = "NAMES",
     .about = "compiles each of these kernels by itself, instead of examining devices, and prints "
              "those that a driver cannot compile; also runs one item of a kernel that needs no "
              "input. NAMES: names separated by commas, or all",
     .offset = AT(kernels)},
    {RG_OPTION_FLAG, "fixed-function", .excludes = "kernels",
     .about = "draws one fixed function after the other through each driver's own graphics "
              "pipeline, instead of examining devices, and prints a digest of each draw",
     .offset = AT(fixed_function)},
    {RG_OPTION_FLAG, "prologue",
     .about = "checks whether this machine should measure now, instead of printing a report: ends "
              "with status 75 and one line if others use its processors, heat throttles them, or a "
              "device is not healthy",
     .offset = AT(prologue), .excludes = "kernels json fixed-function"},
    RG_GROUP("Output"),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static void add_name(struct rg_doctor_report *report, const char *name)
{
    struct rg_device_info *info = &report->examinations[report->count++].info;
    snprintf(info->name, sizeof(info->name), "%s", name);
}

// Puts the names in --device into the report; false: bad usage.
static bool take_names(struct rg_doctor_report *report, const char *names)
{
    struct rg_device_name name;
    for (int i = 0; !strcmp(names, "all") && i < report->list.count; i++)
        add_name(report, report->list.infos[i].name);
    while (strcmp(names, "all") != 0 && *names) {
        if (!rg_device_name_read(&names, &name))
            return false;
        if (report->count == RG_MAX_DEVICES)
            return rg_error("--device: more than %d names", RG_MAX_DEVICES);
        add_name(report, name.name);
    }
    return true;
}

// Logs a line for each backend whose driver fails while listing its devices, so that none can be
// examined. Returns an enum rg_exit.
static int complain_of_listing(const struct rg_device_list *list)
{
    int exit = RG_EXIT_PASS;
    for (int i = 0; i < list->missing_count; i++)
        if (list->missing[i].outcome != RG_UNSUPPORTED) {
            rg_driver_error("%s", list->missing[i].why);
            exit = rg_exit_worse(exit, rg_exit_of(list->missing[i].outcome));
        }
    return exit;
}

// A failure outweighs missing devices, which never hide it.
static int verdict(const struct rg_doctor_report *report)
{
    int exit = report->count ? RG_EXIT_PASS : RG_EXIT_UNSUPPORTED;
    for (int i = 0; i < report->count; i++)
        exit = rg_exit_worse(exit, rg_exit_of(report->examinations[i].status));
    return exit;
}

static void describe(struct rg_doctor_report *report)
{
    struct rg_device_info infos[RG_MAX_DEVICES];
    int count = 0;
    for (int i = 0; i < report->count; i++)
        if (report->examinations[i].opened)
            infos[count++] = report->examinations[i].info;
    report->passport = rg_passport_json(infos, count);
    report->warnings = rg_doctor_warnings(&report->list);
}

// Whether a device of this name was just listed.
static bool was_listed(const struct rg_device_list *list, const char *name)
{
    bool found = false;
    for (int i = 0; !found && i < list->count; i++)
        found = !strcmp(list->infos[i].name, name);
    return found;
}

// Reports a listed device that cannot be opened any more as failed: its driver is being replaced,
// or the GPU was reset. The others are still examined.
static void tell_gone(struct rg_examination *examination)
{
    char why[sizeof(examination->why)];
    snprintf(why, sizeof(why), "was listed, and is gone now: %.450s", examination->why);
    memcpy(examination->why, why, sizeof(why));
    examination->is_unknown = false;
}

// Examines the devices; false when a name is unknown.
static bool examine(struct rg_doctor_report *report)
{
    for (int i = 0; i < report->count; i++) {
        struct rg_examination *examination = &report->examinations[i];
        rg_doctor_examine(examination);
        if (examination->is_unknown && was_listed(&report->list, examination->info.name))
            tell_gone(examination);
        if (examination->is_unknown)
            return false;
    }
    return true;
}

// Logs a line for each device that computes wrongly; other failures have been logged.
static void complain(const struct rg_doctor_report *report)
{
    for (int i = 0; i < report->count; i++)
        if (report->examinations[i].status == RG_FAIL)
            rg_error("device '%s': %s", report->examinations[i].info.name,
                     report->examinations[i].why);
}

static int compile(const struct rg_doctor_report *report, const struct doctor_options *o)
{
    json_t *all = o->json ? json_array() : NULL;
    int exit = report->count ? RG_EXIT_PASS : RG_EXIT_UNSUPPORTED;
    for (int i = 0; i < report->count; i++)
        exit = rg_exit_worse(exit,
                             rg_doctor_compile(report->examinations[i].info.name, o->kernels, all));
    if (all) {
        json_dumpf(all, stdout, JSON_INDENT(2));
        printf("\n");
    }
    json_decref(all);
    return strcmp(o->devices, "all") ? exit
                                     : rg_exit_worse(exit, complain_of_listing(&report->list));
}

// The status of all that was examined, whose failures are logged.
static int judge(const struct rg_doctor_report *report, const struct doctor_options *o)
{
    complain(report);
    return rg_exit_worse(verdict(report), strcmp(o->devices, "all")
                                              ? RG_EXIT_PASS
                                              : complain_of_listing(&report->list));
}

// A device that is not there is no reason to try again later.
static int prologue(struct rg_doctor_report *report, const struct doctor_options *o)
{
    struct rg_prologue prologue = {.watch = rg_processors_now, .root = ""};
    if (!rg_prologue_begin(&prologue))
        return RG_EXIT_LATER;
    if (!examine(report))
        return rg_exit_of_error();
    const int exit = judge(report, o);
    if (exit == RG_EXIT_PASS)
        return rg_prologue_end(&prologue) ? RG_EXIT_PASS : RG_EXIT_LATER;
    return exit == RG_EXIT_UNSUPPORTED ? exit : RG_EXIT_LATER;
}

static void print_fixed(json_t *devices, const struct rg_device_info *infos, int count, bool json)
{
    if (!json) {
        rg_doctor_fixed_print(devices);
        return;
    }
    json_t *root =
        json_pack("{si so sO}", "format", 1, "passport",
                  rg_doctor_fixed_passport(devices, infos, count), "fixed_functions", devices);
    json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(6));
    printf("\n");
    json_decref(root);
}

// Passes where some device draws all that it can; a failure outweighs that.
static int draw_fixed(const struct rg_doctor_report *report, const struct doctor_options *o)
{
    struct rg_device_info infos[RG_MAX_DEVICES];
    json_t *devices = json_array();
    int count = 0, exit = RG_EXIT_PASS;
    bool any = false;
    for (int i = 0; i < report->count; i++) {
        infos[count] = (struct rg_device_info){0};
        const int ended =
            rg_doctor_fixed(report->examinations[i].info.name, &infos[count], devices);
        count += *infos[count].name != 0;
        any = any || ended == RG_EXIT_PASS;
        if (ended != RG_EXIT_UNSUPPORTED)
            exit = rg_exit_worse(exit, ended);
    }
    if (exit != RG_EXIT_USAGE)
        print_fixed(devices, infos, count, o->json);
    json_decref(devices);
    if (exit == RG_EXIT_PASS && !any)
        exit = RG_EXIT_UNSUPPORTED;
    return strcmp(o->devices, "all") ? exit
                                     : rg_exit_worse(exit, complain_of_listing(&report->list));
}

static int run(struct rg_doctor_report *report, const struct doctor_options *o)
{
    rg_memory_allow(o->memory_bytes);
    rg_workers.timeout_s = o->timeout_s;
    if (o->kernels && !rg_doctor_knows_kernels(o->kernels))
        return rg_exit_of_error();
    rg_devices_list(&report->list);
    if (!take_names(report, o->devices))
        return rg_exit_of_error();
    if (o->kernels)
        return compile(report, o);
    if (o->prologue)
        return prologue(report, o);
    if (o->fixed_function)
        return draw_fixed(report, o);
    if (!examine(report))
        return rg_exit_of_error();
    describe(report);
    if (o->json)
        rg_doctor_print_json(report);
    else
        rg_doctor_print_text(report);
    return judge(report, o);
}

static int doctor(const void *values, const struct rg_words *arguments)
{
    (void)arguments;
    struct rg_doctor_report *report = rg_alloc(1, sizeof(*report), "report");
    if (!report)
        return RG_EXIT_FAIL;
    report->examinations = rg_alloc(RG_MAX_DEVICES, sizeof(*report->examinations), "report");
    int exit = report->examinations ? run(report, values) : rg_exit_of_error();
    json_decref(report->passport);
    json_decref(report->warnings);
    free(report->examinations);
    free(report);
    return exit;
}

const struct rg_command rg_command_doctor = {
    .name = "doctor",
    .reader = RG_FOR_DRIVERS,
    .usage = "[--device D,...|all] [--kernels NAMES|all] [--fixed-function] [--prologue|--json]",
    .about = "examines the machine and its drivers: arithmetic, drawing and timers",
    .options = options,
    .options_size = sizeof(struct doctor_options),
    .run = doctor,
};
