// raingauge baseline: what a gate's cells do on devices, kept for later gates.
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/cli/command.h"
#include "harness/cli/shared.h"
#include "harness/compare/gate/baseline/make.h"
#include "harness/console/interrupt.h"
#include "harness/record/output.h"
#include "harness/record/passport/key.h"

struct baseline_options {
    char *cells; // a file; NULL: those that are built in
    int launches;
    struct rg_devices_asked devices;
    int64_t memory_bytes;
    char *output; // a file
    bool update, pictures_only;
};

#define AT(field) offsetof(struct baseline_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to keep"),
    {RG_OPTION_TEXT, "cells", .argument = "FILE",
     .about =
         "the cells to run, one a line (docs/expectations.md); without it those that are built "
         "in",
     .offset = AT(cells), .names = RG_NAMES_FILE},
    {RG_OPTION_INT, "launches", .argument = "N",
     .about = "how often each device is started anew, and times each cell", .offset = AT(launches),
     .initial = "24", .least = 8, .most = RG_BASELINE_LAUNCHES},
    {RG_OPTION_FLAG, "pictures",
     .about = "keeps pictures' digests, states and counters, and times nothing",
     .offset = AT(pictures_only), .excludes = "launches"},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "the baseline, which `raingauge gate --baseline FILE` reads", .offset = AT(output),
     .letter = 'o', .names = RG_NAMES_FILE},
    {RG_OPTION_FLAG, "update",
     .about = "writes FILE though one is there and something changes; without it that is only told",
     .offset = AT(update)},
    {RG_OPTION_END},
};

// --- before and after ---

// Whether FILE can be written, and what stands there is a baseline: that is found out before any
// work.
static bool read_old(const char *path, struct rg_baseline *old, bool *is_there)
{
    enum { BYTES = 1 << 20 };
    struct stat st;
    *is_there = !stat(path, &st);
    return rg_output_file_can_be_written(path, BYTES) &&
           (!*is_there || rg_baseline_read(old, path));
}

// By how much launches of a device scatter, in median of its cells: of a machine that does other
// work too, a baseline tells little.
static void print_scatter(const struct rg_baseline *made, const char *device)
{
    double scatters[RG_GATE_CELLS];
    int count = 0;
    for (int64_t i = 0; i < made->count; i++) {
        const struct rg_baseline_row *row = &made->rows[i];
        if (!strcmp(row->device, device) && row->launches.count)
            scatters[count++] = rg_baseline_scatter(&row->launches);
    }
    if (count)
        printf("; a launch scatters by %.1f %%", 100 * rg_median(scatters, count).median);
}

static void print_keys(const struct rg_baseline *made)
{
    for (int i = 0; i < made->device_count; i++) {
        char key[RG_KEY_SIZE];
        rg_key_hash(made->devices[i].parts, key);
        printf("%s: key %s", made->devices[i].name, key);
        print_scatter(made, made->devices[i].name);
        printf("\n");
    }
}

// What went wrong while it was made, a line a cell: the baseline has that too.
static int print_failures(const struct rg_baseline *made)
{
    int counts[RG_OUTCOME_COUNT] = {0};
    for (int64_t i = 0; i < made->count; i++) {
        const struct rg_baseline_row *row = &made->rows[i];
        counts[row->outcome]++;
        if (row->outcome != RG_OK)
            printf("%s.%s: %s: %s\n", row->cell, row->device, rg_outcome_name(row->outcome),
                   row->why);
    }
    return rg_exit_of_all(counts);
}

static int write_it(const struct baseline_options *o, const struct rg_baseline *made)
{
    if (!rg_baseline_write(made, o->output))
        return RG_EXIT_FAIL;
    printf("%s: %lld cells on %d device%s\n", o->output,
           (long long)(made->count / made->device_count), made->device_count,
           made->device_count == 1 ? "" : "s");
    return RG_EXIT_PASS;
}

static int keep(const struct baseline_options *o, const struct rg_baseline *old, bool is_there,
                const struct rg_baseline *made)
{
    print_keys(made);
    const int failures = print_failures(made);
    const int changes = is_there ? rg_baseline_print_changes(old, made, stdout) : 0;
    if (is_there && !changes) {
        printf("%s: nothing changes\n", o->output);
        return failures;
    }
    if (is_there && !o->update) {
        printf("%s: %d change%s; it is as it was: --update writes them\n", o->output, changes,
               changes == 1 ? "" : "s");
        return RG_EXIT_FAIL;
    }
    return rg_exit_worse(write_it(o, made), failures);
}

// --- the command ---

static int make(const struct baseline_options *o, const struct rg_gate_cells *cells,
                const struct rg_baseline *old, bool is_there)
{
    const struct rg_baseline_request request = {.cells = cells,
                                                .launches = o->pictures_only ? 0 : o->launches};
    struct rg_baseline made = {.count = 0};
    struct rg_devices devices;
    int exit = rg_devices_open_asked(&o->devices, &devices);
    if (exit == RG_EXIT_PASS) {
        if (rg_baseline_make(&request, &devices, &made))
            exit = keep(o, old, is_there, &made);
        else
            exit = rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal() : RG_EXIT_FAIL;
    }
    rg_baseline_free(&made);
    return exit;
}

static int baseline(const void *values, const struct rg_words *arguments)
{
    const struct baseline_options *o = values;
    struct rg_gate_cells cells = {.count = 0};
    struct rg_baseline old = {.count = 0};
    bool is_there;
    int exit = RG_EXIT_USAGE;
    (void)arguments;
    rg_memory_allow(o->memory_bytes);
    if (!o->output)
        rg_error("baseline: name the file to write, as in `raingauge baseline -o "
                 "results/baseline.json`");
    else if (rg_gate_cells_read(o->cells, &cells) && read_old(o->output, &old, &is_there))
        exit = make(o, &cells, &old, is_there);
    rg_baseline_free(&old);
    rg_gate_cells_free(&cells);
    return exit;
}

const struct rg_command rg_command_baseline = {
    .name = "baseline",
    .usage = "-o FILE [--device D,...] [--cells FILE] [--launches N] [--update]",
    .about = "keeps what a gate's cells do on devices, for `raingauge gate --baseline`",
    .options = options,
    .options_size = sizeof(struct baseline_options),
    .run = baseline,
};
