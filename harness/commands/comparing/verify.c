// raingauge verify: checks that all devices compute the same rain, and that it obeys its laws.
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/compare/verify/verify.h"

enum { STAGE_FRAMES = 3, MAX_TECHNIQUES = 16 };

struct verify_options {
    struct rg_words sets;
    struct rg_size size;
    int steps; // -1: by poses and length
    struct rg_length length;
    bool stages;
    struct rg_devices_asked devices;
    int64_t memory_bytes;
    bool json;
};

#define AT(field) offsetof(struct verify_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to verify"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about = "techniques to verify; `raingauge list techniques` prints the names, and no name "
              "means all techniques",
     .names = RG_NAMES_TECHNIQUE, .first = 1},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    {RG_OPTION_FLAG, "quick", .offset = AT(length.quick), .excludes = "full",
     .about = "runs only the poses that show most, for few steps (100, unless a pose has its own "
              "number)"},
    {RG_OPTION_FLAG, "full", .offset = AT(length.full),
     .about = "runs every pose with three seeds, for all its steps (1,000, unless a pose has its "
              "own number). Without --quick and --full: a fifth of the steps, with three seeds for "
              "the first pose and one seed for each other pose"},
    RG_INCLUDE(rg_frame_option, AT(steps), NULL),
    RG_INCLUDE(rg_size_option, AT(size), RG_DEFAULT_SIZE),
    {RG_OPTION_FLAG, "stages", .offset = AT(stages),
     .about = "draws 3 frames, or those of --frame, names the first stage that leaves different "
              "bits in an asset, and verifies nothing else"},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static const char reference_name[] = "cpu:reference", mutant_name[] = "cpu";

struct subject {
    const struct rg_technique *technique;
    void *settings;
};

static bool choose(const struct rg_words *sets, const struct rg_technique *technique,
                   struct subject *subjects, int *count)
{
    if (*count == MAX_TECHNIQUES)
        return rg_error("technique '%s': more than %d of them", technique->name, MAX_TECHNIQUES);
    subjects[*count].technique = technique;
    return (subjects[(*count)++].settings = rg_subject_settings(technique, sets)) != NULL;
}

// Chooses the techniques among the arguments, or all, with the user's settings.
static bool choose_all(const struct rg_words *names, const struct rg_words *sets,
                       struct subject *subjects, int *count)
{
    bool ok = true;
    for (int i = 0; ok && i < names->count; i++) {
        const struct rg_technique *technique = rg_subject_technique(names->items[i]);
        ok = technique && choose(sets, technique, subjects, count);
    }
    for (int i = 0; ok && !names->count && rg_techniques[i]; i++)
        ok = choose(sets, rg_techniques[i], subjects, count);
    return ok;
}

// The device of this name in `devices`, or opened in addition into *extra.
static struct rg_device *find_or_open(const struct rg_devices *devices, const char *name,
                                      struct rg_device **extra)
{
    for (int i = 0; i < devices->count; i++)
        if (!strcmp(devices->devices[i]->info.name, name))
            return devices->devices[i];
    return *extra = rg_devices_open_one(name);
}

// Reports devices that are missing or failed.
static void note_absent(const struct rg_devices *devices, const struct subject *subjects, int count,
                        struct rg_checks *checks)
{
    for (int s = 0; s < count; s++)
        for (int i = 0; i < devices->absent_count; i++)
            rg_checks_add(checks, subjects[s].technique->name, "device", devices->absent[i].name,
                          devices->absent[i].outcome, "%s", devices->absent[i].why);
}

static void verify_all(struct rg_verify *v, bool stages, const struct subject *subjects, int count)
{
    int64_t work = 0;
    for (int i = 0; i < count; i++) {
        v->technique = subjects[i].technique;
        work +=
            stages ? rg_verify_stage_work(v) : rg_verify_device_work(v) + rg_verify_mutant_work(v);
    }
    struct rg_progress progress;
    v->progress = &progress;
    rg_progress_start(&progress, work);
    for (int i = 0; i < count; i++) {
        v->technique = subjects[i].technique;
        v->settings = subjects[i].settings;
        if (stages) {
            rg_verify_stages(v);
            continue;
        }
        rg_verify_devices(v);
        rg_verify_mutants(v);
    }
    rg_progress_end(&progress);
    v->progress = NULL;
}

static void print_checks(const struct rg_checks *checks, const struct rg_devices *devices,
                         bool json)
{
    const struct rg_device_info *infos[RG_MAX_DEVICES];
    for (int i = 0; i < devices->count; i++)
        infos[i] = &devices->devices[i]->info;
    rg_checks_print(checks, infos, devices->count, json);
}

static int verify_on(const struct verify_options *o, const struct rg_devices *devices,
                     const struct subject *subjects, int count)
{
    struct rg_checks checks = {0};
    struct rg_device *extra[2] = {NULL, NULL};
    struct rg_verify v = {
        .width = o->size.width,
        .height = o->size.height,
        .length = o->length.quick  ? RG_VERIFY_QUICK
                  : o->length.full ? RG_VERIFY_FULL
                                   : RG_VERIFY_USUAL,
        .steps = o->steps < 0 && o->stages ? STAGE_FRAMES : o->steps,
        .reference = find_or_open(devices, reference_name, &extra[0]),
        .mutant_device = find_or_open(devices, mutant_name, &extra[1]),
        .devices = devices,
        .checks = &checks,
    };
    int exit;
    if (!v.reference || !v.mutant_device) {
        exit = rg_exit_of_error();
    } else {
        note_absent(devices, subjects, count, &checks);
        verify_all(&v, o->stages, subjects, count);
        print_checks(&checks, devices, o->json);
        exit = rg_checks_exit(&checks);
        if (!checks.count)
            rg_error("verify: no device is held against cpu:reference; name another by --device");
    }
    rg_checks_free(&checks);
    for (int i = 0; i < 2; i++)
        if (!rg_device_close(extra[i]))
            exit = rg_exit_worse(exit, RG_EXIT_FAIL);
    return exit;
}

// Stages run only in frames: without frames nothing would be compared, which would pass.
static bool check_frames(const struct verify_options *o)
{
    return !o->stages || o->steps != 0 ||
           rg_error("--frame 0: --stages compares what the stages of frames leave, at least of 1");
}

static int verify(const void *values, const struct rg_words *arguments)
{
    const struct verify_options *o = values;
    struct subject subjects[MAX_TECHNIQUES] = {{0}};
    struct rg_devices devices;
    int count = 0, exit;
    rg_memory_allow(o->memory_bytes);
    if (check_frames(o) && choose_all(arguments, &o->sets, subjects, &count)) {
        exit = rg_devices_open_asked(&o->devices, &devices);
        if (exit == RG_EXIT_PASS)
            exit = rg_devices_end(&devices, verify_on(o, &devices, subjects, count));
    } else {
        exit = rg_exit_of_error();
    }
    for (int i = 0; i < count; i++)
        free(subjects[i].settings);
    return exit;
}

const struct rg_command rg_command_verify = {
    .name = "verify",
    .reader = RG_FOR_DRIVERS,
    .usage = "[TECHNIQUE...] [--device D,...|all] [--quick|--full] [--set KEY=VALUE]... [--json]",
    .about = "checks that all devices compute the same states and pictures, that laws hold, and "
             "that mutants (deliberate faults) are noticed",
    .options = options,
    .options_size = sizeof(struct verify_options),
    .run = verify,
};
