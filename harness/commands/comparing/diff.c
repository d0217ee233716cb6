// raingauge diff: compares two files, or one frame of a technique on every pair of devices.
#include <stdlib.h>
#include <sys/stat.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/compare/diff/devices.h"
#include "harness/compare/diff/files.h"

struct diff_options {
    struct rg_words sets;
    struct rg_size size;
    int frames;
    struct rg_devices_asked devices;
    char *background, *heatmap_prefix; // files
    double exposure;
    int64_t memory_bytes;
    bool mutants, features, json;
};

#define AT(field) offsetof(struct diff_options, field)

static const struct rg_option options[] = {
    RG_GROUP_OF(1, "What to compare: a technique on devices"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about = "the technique whose frame each pair of devices draws; `raingauge list techniques` "
              "prints the names",
     .names = RG_NAMES_TECHNIQUE, .first = 1, .last = 1},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    RG_INCLUDE(rg_frame_option, AT(frames), "60"),
    RG_INCLUDE(rg_size_option, AT(size), RG_DEFAULT_SIZE),
    {RG_OPTION_FLAG, "mutants", .offset = AT(mutants),
     .about = "for a pair that misses its tier, names the mutants (deliberate faults) of "
              "`raingauge verify` that would pass the tier that the pair reaches"},
    {RG_OPTION_FLAG, "features", .offset = AT(features),
     .about =
         "for a pair with a native device, switches the driver's features to the exact way one "
         "at a time, and names those by which the pictures differ (docs/native.md)"},
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_GROUP_OF(2, "What to compare: two files"),
    // The operand is unlimited in number, so that a wrong number of arguments reaches the check
    // below.
    {RG_OPTION_OPERAND, .argument = "A B", .about = "picture files of one size; A is the reference",
     .names = RG_NAMES_FILE, .first = 1},
    {RG_OPTION_TEXT, "background", .argument = "FILE",
     .about = "the picture without rain; only differences where it rains count",
     .offset = AT(background), .names = RG_NAMES_FILE},
    RG_GROUP("For both"),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "PREFIX",
     .about = "writes heat maps, and each device's picture as EXR, into files whose names begin "
              "with PREFIX",
     .offset = AT(heatmap_prefix), .letter = 'o', .names = RG_NAMES_FILE},
    RG_INCLUDE(rg_exposure_option, AT(exposure), "1"),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static int diff_devices(const struct diff_options *o, const struct rg_words *arguments)
{
    void *settings;
    const struct rg_technique *technique = rg_subject_find(arguments, &o->sets, &settings);
    if (!technique)
        return rg_exit_of_error();
    const int exit = rg_diff_devices(&(struct rg_diff_devices_request){
        .subject = {technique, settings, o->size.width, o->size.height},
        .devices = &o->devices,
        .frames = o->frames,
        .heatmap_prefix = o->heatmap_prefix,
        .exposure = o->exposure,
        .mutants = o->mutants,
        .features = o->features,
        .json = o->json,
    });
    free(settings);
    return exit;
}

// A technique's name means the technique, even if a folder has that name.
static bool are_no_folders(const struct rg_words *arguments)
{
    struct stat status;
    for (int i = 0; i < arguments->count; i++)
        if ((arguments->count > 1 || !rg_technique_find(arguments->items[i])) &&
            stat(arguments->items[i], &status) == 0 && S_ISDIR(status.st_mode))
            return rg_error(
                "diff: '%s' is a folder; name two pictures, and call diff once for each "
                "pair of files",
                arguments->items[i]);
    return true;
}

static int diff(const void *values, const struct rg_words *arguments)
{
    const struct diff_options *o = values;
    rg_memory_allow(o->memory_bytes);
    if (!are_no_folders(arguments))
        return RG_EXIT_USAGE;
    if (arguments->count == 1)
        return diff_devices(o, arguments);
    if (arguments->count != 2) {
        rg_error("diff: name a technique, or two image files; `raingauge diff --help` explains");
        return rg_exit_of_error();
    }
    return rg_diff_files(&(struct rg_diff_request){
        .a = arguments->items[0],
        .b = arguments->items[1],
        .background = o->background,
        .heatmap_prefix = o->heatmap_prefix,
        .json = o->json,
        .options = {.exposure = (float)o->exposure},
    });
}

const struct rg_command rg_command_diff = {
    .name = "diff",
    .reader = RG_FOR_DRIVERS,
    .usage = "TECHNIQUE [--device A,B,...]  |  A.exr B.exr [--background FILE]",
    .about = "compares the pictures of devices pair by pair, or two picture files; -o PREFIX "
             "writes heat maps",
    .options = options,
    .options_size = sizeof(struct diff_options),
    .run = diff,
};
