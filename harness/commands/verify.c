// raingauge verify: whether all devices compute the same rain, and whether that rain obeys its
// laws.
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/verify/verify.h"
#include "harness/frames/frame.h"

enum { QUICK_STEPS = 100, FULL_STEPS = 1000, MAX_TECHNIQUES = 16 };

static const char reference_name[] = "cpu:reference", mutant_name[] = "cpu";

struct subject {
    const struct rg_technique *technique;
    void *settings;
};

static bool choose(const struct rg_options *o, const struct rg_technique *technique,
                   struct subject *subjects, int *count)
{
    if (*count == MAX_TECHNIQUES)
        return rg_error("technique '%s': more than %d of them", technique->name, MAX_TECHNIQUES);
    subjects[*count].technique = technique;
    return (subjects[(*count)++].settings = rg_options_settings(o, technique)) != NULL;
}

// The techniques that the arguments name, or all; with the user's settings.
static bool choose_all(const struct rg_options *o, struct subject *subjects, int *count)
{
    bool ok = true;
    for (int i = 0; ok && i < o->arg_count; i++) {
        const struct rg_technique *technique = rg_technique_find(o->args[i]);
        if (!technique)
            return rg_error("technique '%s': unknown; `raingauge list techniques` prints them",
                            o->args[i]);
        ok = choose(o, technique, subjects, count);
    }
    for (int i = 0; ok && !o->arg_count && rg_techniques[i]; i++)
        ok = choose(o, rg_techniques[i], subjects, count);
    return ok;
}

// The device of this name among `devices`, or opened beside them into *extra.
static struct rg_device *find_or_open(const struct rg_devices *devices, const char *name,
                                      struct rg_device **extra)
{
    for (int i = 0; i < devices->count; i++)
        if (!strcmp(devices->devices[i]->info.name, name))
            return devices->devices[i];
    return *extra = rg_device_open(name, NULL);
}

// A driver that is there and does not open its device is no lack, but a failure.
static void note_broken(const struct rg_devices *devices, const struct subject *subjects, int count,
                        struct rg_checks *checks)
{
    for (int s = 0; s < count; s++)
        for (int i = 0; i < devices->broken_count; i++)
            rg_checks_add(checks, subjects[s].technique->name, "device", devices->broken[i].name,
                          RG_ERROR, "%s", devices->broken[i].why);
}

// What the machine lacks is said, not passed over.
static void note_missing(const struct rg_devices *devices, const struct subject *subjects,
                         int count, struct rg_checks *checks)
{
    for (int s = 0; s < count; s++) {
        for (int i = 0; devices->missing[i][0]; i++) {
            char name[32] = "";
            strncat(name, devices->missing[i], strcspn(devices->missing[i], " "));
            name[strlen(name) - (name[0] && name[strlen(name) - 1] == ':')] = 0;
            rg_checks_add(checks, subjects[s].technique->name, "device", name, RG_UNSUPPORTED, "%s",
                          devices->missing[i]);
        }
    }
}

static void verify_all(struct rg_verify *v, const struct subject *subjects, int count)
{
    int64_t work = 0;
    for (int i = 0; i < count; i++) {
        v->technique = subjects[i].technique;
        work += rg_verify_device_work(v) + rg_verify_mutant_work(v);
    }
    struct rg_progress progress;
    v->progress = &progress;
    rg_progress_start(&progress, work);
    for (int i = 0; i < count; i++) {
        v->technique = subjects[i].technique;
        v->settings = subjects[i].settings;
        rg_verify_devices(v);
        rg_verify_mutants(v);
    }
    rg_progress_end(&progress);
}

static int verify_on(const struct rg_options *o, const struct rg_devices *devices,
                     const struct subject *subjects, int count)
{
    struct rg_checks checks = {0};
    struct rg_device *extra[2] = {NULL, NULL};
    struct rg_verify v = {
        .width = o->width ? o->width : RG_FRAME_SIZE_PX,
        .height = o->height ? o->height : RG_FRAME_SIZE_PX,
        .steps = o->frame >= 0 ? o->frame
                 : o->quick    ? QUICK_STEPS
                               : FULL_STEPS,
        .reference = find_or_open(devices, reference_name, &extra[0]),
        .mutant_device = find_or_open(devices, mutant_name, &extra[1]),
        .devices = devices,
        .checks = &checks,
    };
    int exit = RG_EXIT_UNSUPPORTED;
    if (v.reference && v.mutant_device) {
        note_missing(devices, subjects, count, &checks);
        note_broken(devices, subjects, count, &checks);
        verify_all(&v, subjects, count);
        rg_checks_print(&checks, o->json);
        exit = rg_checks_exit(&checks);
    }
    rg_checks_free(&checks);
    for (int i = 0; i < 2; i++)
        if (extra[i] && !rg_device_close(extra[i]))
            exit = RG_EXIT_FAIL;
    return exit;
}

static int verify(const struct rg_options *o)
{
    struct subject subjects[MAX_TECHNIQUES] = {{0}};
    struct rg_devices devices;
    int count = 0, exit = RG_EXIT_USAGE;
    if (choose_all(o, subjects, &count)) {
        exit = rg_devices_open(o, "all", &devices);
        if (exit == RG_EXIT_PASS) {
            exit = verify_on(o, &devices, subjects, count);
            if (!rg_devices_close(&devices))
                exit = RG_EXIT_FAIL;
        }
    }
    for (int i = 0; i < count; i++)
        free(subjects[i].settings);
    return exit;
}

const struct rg_command rg_command_verify = {
    .name = "verify",
    .usage = "[TECHNIQUE...] [--device D,...|all] [--quick|--full] [--set KEY=VALUE]... [--json]",
    .about = "proves that all devices compute the same: 1,000 steps, --quick 100; laws and mutants",
    .options =
        RG_OPT_DEVICE | RG_OPT_LENGTH | RG_OPT_SET | RG_OPT_SIZE | RG_OPT_FRAME | RG_OPT_JSON,
    .run = verify,
};
