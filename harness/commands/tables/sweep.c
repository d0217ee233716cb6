// raingauge sweep: measures a table of the user's own, from axes.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/memory.h"
#include "core/base/log.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/commands/tables/inputs.h"
#include "harness/commands/tables/sets.h"
#include "harness/console/exit.h"
#include "harness/devices/measure/expected.h"
#include "harness/devices/names.h"
#include "harness/record/output.h"
#include "harness/tables/own/estimate.h"
#include "harness/tables/print.h"
#include "harness/tables/runs/regenerate.h"
#include "harness/tables/own/grid.h"

struct sweep_options {
    struct rg_words axes, sets;
    struct rg_size size;
    int frame;
    struct rg_length length;
    struct rg_devices_asked devices;
    char *output;
    int format;
    int64_t memory_bytes;
    bool dry_run, fresh, wide, json;
};

#define AT(field) offsetof(struct sweep_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to measure"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about = "the technique to time; `raingauge list techniques` prints the names",
     .names = RG_NAMES_TECHNIQUE, .first = 1, .last = 1},
    {RG_OPTION_TEXTS, "axis", .argument = "KEY=VALUES",
     .about = "a parameter and its values: 5,10,40; or 5,10..40 in equal steps. Two axes combine "
              "each value of one with each value of the other. device=cpu,gl names devices, as "
              "--device does (default cpu)",
     .offset = AT(axes), .names = RG_NAMES_PARAMETER},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    RG_INCLUDE(rg_size_option, AT(size), "1280x720"),
    RG_INCLUDE(rg_frame_option, AT(frame), "10"),
    RG_INCLUDE(rg_length_options, AT(length), NULL),
    {RG_OPTION_FLAG, "dry-run", .about = "prints the plan, instead of measuring",
     .offset = AT(dry_run)},
    {RG_OPTION_FLAG, "fresh", .about = "ignores the measurements that an interrupted run stored",
     .offset = AT(fresh)},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), NULL),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_FLAG, "wide", .about = "prints all columns and notes, one line a cell",
     .offset = AT(wide), .excludes = "format json"},
    {RG_OPTION_CHOICE, "format", .about = "the format of the output", .offset = AT(format),
     .choices = rg_result_formats, .initial = "md"},
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "writes the table into this folder too, in every format", .offset = AT(output),
     .letter = 'o', .names = RG_NAMES_FOLDER},
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static int print(const struct rg_result *result, const void *user)
{
    const struct sweep_options *o = user;
    const int form = o->json ? RG_RESULT_JSON : o->wide ? RG_RESULT_WIDE : o->format;
    return rg_result_finish(result, form, o->output);
}

// Names of devices may contain commas and dots, so they are not read as a parameter's values.
#define DEVICE_AXIS "device="

// Reads the axes. The axis of devices is not part of the grid; *devices gets its names, which the
// caller frees. False, and one logged line, if one is refused.
static bool read_axes(const struct rg_words *words, struct rg_grid *grid, char **devices)
{
    for (int i = 0; i < words->count; i++) {
        const char *text = words->items[i];
        if (strncmp(text, DEVICE_AXIS, strlen(DEVICE_AXIS)) != 0) {
            if (grid->axis_count == RG_GRID_AXES)
                return rg_error("--axis: more than %d axes", RG_GRID_AXES);
            if (!rg_axis_read("--axis", text, &grid->axes[grid->axis_count++]))
                return false;
            continue;
        }
        if (*devices)
            return rg_error("--axis device: stands twice; name all devices at once");
        if (!rg_device_names_check("--axis device", text + strlen(DEVICE_AXIS)))
            return false;
        if (!(*devices = strdup(text + strlen(DEVICE_AXIS))))
            return rg_harness_error("--axis device: no memory");
    }
    return grid->axis_count ||
           rg_error("--axis: none is of a parameter; name one, as in --axis seed=1,2..5");
}

// Prints the time and memory that measuring the table would take.
static int plan(const struct rg_grid *grid, const struct rg_devices *devices,
                const struct sweep_options *o, const char *set)
{
    struct rg_kept kept = {.devices = devices};
    struct rg_plan plan;
    const bool planned = rg_plan_make(&grid->table, set, o->length.full, &kept, &plan);
    if (!rg_kept_free(&kept) || !planned)
        return rg_exit_of_error();
    rg_plan_print(&plan, devices, stdout);
    return plan.failed ? rg_exit_of_error() : RG_EXIT_PASS;
}

static int measure(const struct rg_grid *grid, const struct rg_devices *devices,
                   const struct sweep_options *o, const char *set)
{
    const struct rg_table *const tables[] = {&grid->table};
    const struct rg_regenerate_options wanted = {.full = o->length.full,
                                                 .fresh = o->fresh,
                                                 .set = set,
                                                 .folder = o->output,
                                                 .print = print,
                                                 .user = o};
    return rg_tables_regenerate(tables, 1, devices, &wanted);
}

// An axis of devices replaces --device.
static int open_and_run(struct rg_grid *grid, const struct sweep_options *o, char *names,
                        const char *set)
{
    struct rg_devices devices;
    struct rg_devices_asked asked = o->devices;
    if (names && asked.names) {
        rg_error("--axis device: --device names devices too; leave one of the two out");
        return rg_exit_of_error();
    }
    asked.names = names ? names : asked.names ? asked.names : "cpu";
    int exit = rg_devices_open_asked(&asked, &devices);
    if (exit != RG_EXIT_PASS)
        return exit;
    exit = rg_exit_worse((o->dry_run ? plan : measure)(grid, &devices, o, set),
                         rg_devices_exit(&devices));
    return rg_devices_end(&devices, exit);
}

static int run_grid(struct rg_grid *grid, const struct sweep_options *o,
                    const struct rg_words *arguments)
{
    void *settings = NULL;
    char *names = NULL, *set = NULL;
    const struct rg_technique *technique = rg_subject_find(arguments, &o->sets, &settings);
    const struct rg_table *const table = &grid->table;
    bool ok = technique && read_axes(&o->axes, grid, &names) && rg_grid_make(grid, technique) &&
              rg_sets_join(&o->sets, &set) &&
              rg_grid_keeps_axes(grid, technique, o->sets.items, o->sets.count);
    grid->table.width = o->size.width;
    grid->table.height = o->size.height;
    grid->table.check_frames = o->frame;
    ok = ok && rg_inputs_are_spared(&table, 1, set, o->output) &&
         (!o->output || rg_results_can_be_written(&table, 1, o->output));
    const int exit = ok ? open_and_run(grid, o, names, set) : rg_exit_of_error();
    free(settings);
    free(names);
    free(set);
    return exit;
}

static int sweep(const void *values, const struct rg_words *arguments)
{
    const struct sweep_options *o = values;
    struct rg_grid *grid = rg_alloc(1, sizeof(*grid), "sweep");
    rg_memory_allow(o->memory_bytes);
    const int exit = grid ? run_grid(grid, values, arguments) : rg_exit_of_error();
    free(grid);
    return exit;
}

const struct rg_command rg_command_sweep = {
    .name = "sweep",
    .reader = RG_FOR_PAPERS,
    .usage = "TECHNIQUE --axis KEY=VALUES [--axis KEY=VALUES]... [--set KEY=VALUE]... [--size WxH] "
             "[--frame N] [--device D,...|all] [--quick|--full] [--dry-run] [--fresh] [--wide] "
             "[--format F|--json] [-o DIR]",
    .about = "measures a table of your own: each value of a parameter on each device",
    .options = options,
    .options_size = sizeof(struct sweep_options),
    .run = sweep,
};
