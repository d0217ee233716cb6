// raingauge trace: frames on devices as a timeline for Perfetto.
#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/console/interrupt.h"
#include "harness/devices/devices.h"
#include "harness/devices/frames/trace.h"
#include "harness/record/output.h"
#include "harness/record/schema/schema.h"

struct trace_options {
    struct rg_words sets;
    struct rg_size size;
    int frames;
    struct rg_devices_asked devices;
    char *output; // a file
    int64_t memory_bytes;
};

#define AT(field) offsetof(struct trace_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to trace"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about = "the technique to draw; `raingauge list techniques` prints the names",
     .names = RG_NAMES_TECHNIQUE, .first = 1, .last = 1},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    {RG_OPTION_INT, "count", .argument = "N",
     .about = "number of frames to time without waits; as many more are timed with a wait after "
              "each pass",
     .offset = AT(frames), .least = 1, .most = 1000, .initial = "10"},
    RG_INCLUDE(rg_size_option, AT(size), RG_DEFAULT_SIZE),
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "the trace file, for ui.perfetto.dev and chrome://tracing", .offset = AT(output),
     .letter = 'o', .initial = "trace.json", .names = RG_NAMES_FILE},
    {RG_OPTION_END},
};

// Writes the trace of the devices that were reached, also after a failure or an interruption.
static bool write_trace(const struct trace_options *o, struct rg_trace *trace,
                        const struct rg_devices *devices)
{
    static struct rg_device_info infos[RG_MAX_DEVICES];
    const int count = trace->devices;
    for (int i = 0; i < count; i++)
        infos[i] = devices->devices[i]->info;
    char *text = rg_trace_end(trace, infos, count);
    const bool ok = text && rg_output_write_file(o->output, text);
    free(text);
    if (ok)
        printf("%s: %d frames, and as many by pass, on %d device%s\n", o->output, o->frames, count,
               count == 1 ? "" : "s");
    return ok;
}

static int trace_devices(const struct trace_options *o, const struct rg_subject *subject)
{
    struct rg_devices devices;
    struct rg_trace trace;
    int exit = rg_devices_open_asked(&o->devices, &devices);
    if (exit != RG_EXIT_PASS)
        return exit;
    rg_trace_begin(&trace);
    for (int i = 0; i < devices.count && !rg_interrupted(); i++)
        if (!rg_trace_device(&trace, devices.devices[i], subject, o->frames))
            exit = rg_exit_worse(exit, rg_exit_of_error());
    if (!write_trace(o, &trace, &devices))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    if (rg_interrupted())
        exit = RG_EXIT_SIGNALLED + rg_interrupt_signal();
    return rg_devices_end(&devices, rg_exit_worse(exit, rg_devices_exit(&devices)));
}

static int trace_command(const void *values, const struct rg_words *arguments)
{
    enum { BYTES = 1 << 20 };
    const struct trace_options *o = values;
    void *settings;
    rg_memory_allow(o->memory_bytes);
    const struct rg_technique *technique = rg_subject_find(arguments, &o->sets, &settings);
    if (!technique)
        return rg_exit_of_error();
    const struct rg_subject subject = {technique, settings, o->size.width, o->size.height};
    const bool can_write =
        rg_files_spared_by(&subject, o->output) && rg_output_file_can_be_written(o->output, BYTES);
    const int exit = can_write ? trace_devices(o, &subject) : rg_exit_of_error();
    free(settings);
    return exit;
}

const struct rg_command rg_command_trace = {
    .name = "trace",
    .reader = RG_FOR_DRIVERS,
    .usage = "TECHNIQUE [--device D,...|all] [--count N] [--size WxH] [--set KEY=VALUE]... "
             "[-o FILE]",
    .about = "times frames and their passes on each device, and writes a timeline for Perfetto",
    .options = options,
    .options_size = sizeof(struct trace_options),
    .run = trace_command,
};
