// raingauge figures: redraws figures of the papers into a folder.
#include <stdio.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/text/words.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/console/interrupt.h"
#include "harness/devices/devices.h"
#include "harness/devices/names.h"
#include "harness/tables/figures/figures.h"

struct figures_options {
    struct rg_size size;
    char *device, *output;
    int timeout_s;
    int64_t memory_bytes;
};

#define AT(field) offsetof(struct figures_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to draw"),
    {RG_OPTION_OPERAND, .argument = "ID...",
     .about = "figures to draw; `raingauge list figures` prints the names, and no name means all "
              "figures",
     .names = RG_NAMES_FIGURE, .first = 1},
    RG_INCLUDE(rg_size_option, AT(size), RG_DEFAULT_SIZE),
    RG_GROUP("Devices"),
    {RG_OPTION_TEXT, "device", .argument = "D",
     .about = "the device to use; `raingauge list devices` prints the names", .offset = AT(device),
     .initial = "cpu", .names = RG_NAMES_DEVICE},
    RG_INCLUDE(rg_timeout_option, AT(timeout_s), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "the folder for the pictures and for figures.md, which shows them with captions",
     .offset = AT(output), .letter = 'o', .initial = "figures", .names = RG_NAMES_FOLDER},
    {RG_OPTION_END},
};

enum { MOST_FIGURES = 128 };

static void refuse(const char *id)
{
    struct rg_nearest nearest = {0};
    const struct rg_figure *figure;
    for (int i = 0; (figure = rg_figure_at(i)); i++)
        rg_nearest_try(&nearest, id, figure->id);
    rg_error("figure '%s': unknown; the nearest is '%s', and `raingauge list figures` prints them",
             id, nearest.name);
}

// The figures that are named, or all; how many, 0 with one logged line.
static int choose(const struct rg_words *names, const struct rg_figure *figures[MOST_FIGURES])
{
    const struct rg_figure *figure;
    int count = 0;
    for (int i = 0; i < names->count; i++) {
        if (!(figures[i] = rg_figure_find(names->items[i]))) {
            refuse(names->items[i]);
            return 0;
        }
    }
    if (names->count)
        return names->count;
    while (count < MOST_FIGURES && (figure = rg_figure_at(count)))
        figures[count++] = figure;
    return count;
}

static int figures_command(const void *values, const struct rg_words *arguments)
{
    const struct figures_options *o = values;
    const struct rg_figure *figures[MOST_FIGURES];
    const int count = choose(arguments, figures);
    struct rg_devices devices;
    rg_memory_allow(o->memory_bytes);
    if (!count || !rg_device_names_one(o->device, "figures"))
        return rg_exit_of_error();
    int exit = rg_devices_open_asked(
        &(struct rg_devices_asked){.names = o->device, .timeout_s = o->timeout_s}, &devices);
    if (exit == RG_EXIT_PASS) {
        const struct rg_figure_run run = {.device = devices.devices[0],
                                          .width = o->size.width,
                                          .height = o->size.height,
                                          .folder = o->output,
                                          .figures = figures,
                                          .count = count};
        if (rg_figures_draw(&run))
            printf("%s/figures.md: %d figures\n", o->output, count);
        else
            exit =
                rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal() : rg_exit_of_error();
    }
    exit = rg_devices_end(&devices, exit);
    return exit;
}

const struct rg_command rg_command_figures = {
    .name = "figures",
    .reader = RG_FOR_PAPERS,
    .usage = "[ID...] [--device D] [--size WxH] [-o DIR]",
    .about = "redraws the papers' figures, with captions",
    .options = options,
    .options_size = sizeof(struct figures_options),
    .run = figures_command,
};
