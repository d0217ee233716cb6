// raingauge verify: checks that all devices compute the same rain, and that it obeys its laws.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shard.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/compare/verify/course.h"
#include "harness/record/named.h"
#include "harness/record/output.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/passport.h"

enum { STAGE_FRAMES = 3, MAX_TECHNIQUES = 16 };

struct verify_options {
    struct rg_words sets;
    struct rg_size size;
    int steps; // -1: by poses and length
    struct rg_length length;
    bool stages;
    struct rg_devices_asked devices;
    int64_t memory_bytes;
    char *shard, *output, *from; // NULL: none
    bool json, partial;
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
     .about = "draws 3 frames, or those of --frame, instead of verifying, and names the first "
              "stage that leaves different bits in an asset"},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Shards (docs/ci.md)"),
    RG_INCLUDE(rg_shard_option, AT(shard), NULL),
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "the folder for a shard's record, which all shards share", .offset = AT(output),
     .letter = 'o', .names = RG_NAMES_FOLDER},
    {RG_OPTION_TEXT, "from", .argument = "FILE|DIR",
     .about = "reports what all shards together found, instead of verifying; DIR is the folder of "
              "their -o",
     .offset = AT(from), .names = RG_NAMES_FILE,
     .excludes = "set quick full frame size stages device require timeout shard output"},
    {RG_OPTION_FLAG, "partial", .about = "reports even if shards are missing",
     .offset = AT(partial)},
    RG_GROUP("Output"),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static const char reference_name[] = "cpu:reference", mutant_name[] = "cpu";

static bool choose(const struct rg_words *sets, const struct rg_technique *technique,
                   struct rg_verify_subject *subjects, int *count)
{
    if (*count == MAX_TECHNIQUES)
        return rg_error("technique '%s': more than %d of them", technique->name, MAX_TECHNIQUES);
    subjects[*count].technique = technique;
    return (subjects[(*count)++].settings = rg_subject_settings(technique, sets)) != NULL;
}

// Chooses the techniques among the arguments, or all, with the user's settings.
static bool choose_all(const struct rg_words *names, const struct rg_words *sets,
                       struct rg_verify_subject *subjects, int *count)
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

// --- output ---

// A line for each device, with its driver. NULL without memory.
static char *note_devices(const struct rg_devices *devices)
{
    const struct rg_device_info *infos[RG_MAX_DEVICES];
    char *note = NULL;
    size_t size;
    FILE *out = open_memstream(&note, &size);
    for (int i = 0; i < devices->count; i++)
        infos[i] = &devices->devices[i]->info;
    if (out)
        rg_drivers_print(infos, devices->count, out);
    if (out && !fclose(out))
        return note;
    free(note);
    return rg_harness_error_null("verify: no memory for the names of its devices");
}

static json_t *devices_json(const struct rg_devices *devices)
{
    const struct rg_device_info *infos[RG_MAX_DEVICES];
    for (int i = 0; i < devices->count; i++)
        infos[i] = &devices->devices[i]->info;
    return rg_passport_devices(infos, devices->count);
}

// What else decides what is checked.
static json_t *options_json(const struct verify_options *o)
{
    json_t *sets = json_array();
    for (int i = 0; i < o->sets.count; i++)
        json_array_append_new(sets, rg_json_text(o->sets.items[i]));
    return json_pack("{so sb sb si si si sb}", "set", sets, "quick", o->length.quick, "full",
                     o->length.full, "frame", o->steps, "width", o->size.width, "height",
                     o->size.height, "stages", o->stages);
}

// The record of a shard, which is written once its devices are closed.
struct record {
    json_t *document, *whole; // owned; NULL: there is none
};

static void keep(const struct verify_options *o, const struct rg_verify_course *c, const char *note,
                 struct record *record)
{
    const struct rg_checks *checks = c->verify.checks;
    record->document = rg_checks_document(checks, devices_json(c->devices));
    record->whole = rg_units_whole(&c->units, options_json(o));
    json_object_set_new(record->document, "note", rg_json_text(note));
    json_object_set_new(record->document, "exit", json_integer(checks->exit));
}

// Writes a record, to whose exit status that of closing the devices is added.
static int write_record(const struct verify_options *o, const struct rg_shard *shard,
                        struct record *record, int closing)
{
    const int exit = (int)json_integer_value(json_object_get(record->document, "exit"));
    if (!record->document)
        return RG_EXIT_PASS;
    json_object_set_new(record->document, "exit", json_integer(rg_exit_worse(exit, closing)));
    return rg_part_write("verify", *shard, record->document, record->whole, o->output)
               ? RG_EXIT_PASS
               : rg_exit_of_error();
}

// Prints the checks, and returns their enum rg_exit.
static int tell(const struct verify_options *o, const struct rg_verify_course *c,
                const struct rg_shard *shard, struct record *record)
{
    const struct rg_checks *checks = c->verify.checks;
    char *note = note_devices(c->devices);
    const int exit = note ? rg_checks_exit(checks) : rg_exit_of_error();
    if (note)
        rg_checks_print(checks, note, devices_json(c->devices), o->json);
    if (note && o->shard)
        keep(o, c, note, record);
    if (!rg_units_have_any(&c->units))
        rg_error("verify: shard %d of %d has none of %d units; make it %d shards at most",
                 shard->number, shard->count, c->units.count, c->units.count);
    else if (!checks->count)
        rg_error("verify: no device is held against cpu:reference; name another by --device");
    free(note);
    return exit;
}

static int verify_on(const struct verify_options *o, const struct rg_devices *devices,
                     const struct rg_verify_subject *subjects, int count,
                     const struct rg_shard *shard, struct record *record)
{
    struct rg_device *extra[2] = {NULL, NULL};
    struct rg_checks checks = {0};
    struct rg_verify_course course = {
        .subjects = subjects, .count = count, .devices = devices, .stages = o->stages};
    struct rg_verify *v = &course.verify;
    *v = (struct rg_verify){
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
    if (!v->reference || !v->mutant_device || !rg_verify_choose(&course, shard)) {
        exit = rg_exit_of_error();
    } else {
        rg_verify_run_all(&course);
        exit = tell(o, &course, shard, record);
    }
    rg_checks_free(&checks);
    free(course.units.all);
    for (int i = 0; i < 2; i++)
        if (!rg_device_close(extra[i]))
            exit = rg_exit_worse(exit, RG_EXIT_FAIL);
    return exit;
}

// --- all shards together ---

static int print_parts(const struct verify_options *o, const struct rg_parts *parts)
{
    struct rg_checks checks = {0};
    char *note = NULL;
    int exit = rg_shards_exit(parts, "verify", o->from, o->partial);
    if (exit == RG_EXIT_PASS && rg_checks_merge(parts, &checks) &&
        (note = rg_parts_texts(parts, "note", true))) {
        rg_checks_print(&checks, note, rg_checks_merge_devices(parts), o->json);
        exit = rg_checks_exit(&checks);
    } else if (exit == RG_EXIT_PASS) {
        exit = rg_exit_of_error();
    }
    free(note);
    rg_checks_free(&checks);
    return exit;
}

static int merge(const struct verify_options *o, const struct rg_words *techniques)
{
    struct rg_parts parts = {0};
    const bool ok =
        (!techniques->count || rg_error("--from: the shards had their techniques; leave out '%s'",
                                        techniques->items[0])) &&
        rg_parts_read(&parts, "verify", o->from);
    const int exit = ok ? print_parts(o, &parts) : rg_exit_of_error();
    rg_parts_free(&parts);
    return exit;
}

// --- the command ---

// Stages run only in frames: without frames nothing would be compared, which would pass.
static bool check_frames(const struct verify_options *o)
{
    return !o->stages || o->steps != 0 ||
           rg_error("--frame 0: --stages compares what the stages of frames leave, at least of 1");
}

// Finds the shard; all without one.
static bool find_shard(const struct verify_options *o, struct rg_shard *shard)
{
    *shard = (struct rg_shard){1, 1};
    if (o->partial)
        return rg_error("--partial: is about the records of shards; name them by --from, or leave "
                        "it out");
    if (!o->shard)
        return !o->output || rg_error("-o %s: is for the record of a shard; add --shard, or leave "
                                      "it out",
                                      o->output);
    return (o->output || rg_error("--shard: name the folder of its record, as -o verified, which "
                                  "all shards share")) &&
           rg_shard_read(o->shard, 0, shard) && rg_output_can_be_written(o->output, 1 << 16);
}

static int verify(const void *values, const struct rg_words *arguments)
{
    const struct verify_options *o = values;
    struct rg_verify_subject subjects[MAX_TECHNIQUES] = {{0}};
    struct rg_devices devices;
    struct rg_shard shard;
    struct record record = {NULL, NULL};
    int count = 0, exit;
    rg_memory_allow(o->memory_bytes);
    if (o->from)
        return merge(o, arguments);
    if (check_frames(o) && find_shard(o, &shard) &&
        choose_all(arguments, &o->sets, subjects, &count)) {
        exit = rg_devices_open_asked(&o->devices, &devices);
        if (exit == RG_EXIT_PASS) {
            exit = verify_on(o, &devices, subjects, count, &shard, &record);
            const int closing = rg_devices_end(&devices, RG_EXIT_PASS);
            exit = rg_exit_worse(rg_exit_worse(exit, closing),
                                 write_record(o, &shard, &record, closing));
        }
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
    .usage = "[TECHNIQUE...] [--device D,...|all] [--quick|--full] [--set KEY=VALUE]... [--shard "
             "I/N|auto -o DIR] [--json]  |  --from FILE|DIR [--partial] [--json]",
    .about = "checks that all devices compute the same states and pictures, that laws hold, and "
             "that mutants (deliberate faults) are noticed",
    .options = options,
    .options_size = sizeof(struct verify_options),
    .run = verify,
};
