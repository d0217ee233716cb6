// raingauge baseline: stores what a gate's cells do on devices, for later gates.
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/compare/gate/baseline/baseline.h"
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
     .about = "a file of cells to run, one a line (docs/expectations.md); without this option, the "
              "built-in cells",
     .offset = AT(cells), .names = RG_NAMES_FILE},
    {RG_OPTION_INT, "launches", .argument = "N",
     .about = "the number of launches, each of which restarts every device and times every cell",
     .offset = AT(launches), .initial = "24", .least = 8, .most = RG_BASELINE_LAUNCHES},
    {RG_OPTION_FLAG, "pictures",
     .about = "keeps digests of pictures, states and counters, but no times",
     .offset = AT(pictures_only), .excludes = "launches"},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "the baseline file, for `raingauge gate --baseline FILE`", .offset = AT(output),
     .letter = 'o', .names = RG_NAMES_FILE},
    {RG_OPTION_FLAG, "update",
     .about = "replaces an existing FILE that differs; without this option, the command only "
              "prints the differences",
     .offset = AT(update)},
    {RG_OPTION_END},
};

// --- before and after ---

// The file before any work.
struct before {
    bool is_there;
    struct stat st; // its identity and time
    struct rg_baseline baseline;
};

// Whether the file can be written, and any existing one is a baseline.
static bool look_before(const char *path, struct before *before)
{
    enum { BYTES = 1 << 20 };
    before->is_there = !stat(path, &before->st);
    return rg_output_file_can_be_written(path, BYTES) &&
           (!before->is_there || rg_baseline_read(&before->baseline, path));
}

// A file changed by others meanwhile must not be overwritten.
static bool is_as_before(const char *path, const struct before *before)
{
    struct stat now;
    const bool is_there = !stat(path, &now);
    const struct stat *was = &before->st;
    const bool same =
        is_there == before->is_there &&
        (!is_there || (now.st_dev == was->st_dev && now.st_ino == was->st_ino &&
                       now.st_size == was->st_size && now.st_mtim.tv_sec == was->st_mtim.tv_sec &&
                       now.st_mtim.tv_nsec == was->st_mtim.tv_nsec));
    return same || rg_error("%s: was written by another meanwhile, and stays so; run this again to "
                            "see what changes",
                            path);
}

// Prints how much launches on a device scatter, as the median over its cells: a baseline from a
// busy machine says little.
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

// Prints the failures while it was made, a line for each cell; the baseline includes them.
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

// Whether raingauge itself lacked something: what came of it must not be expected of a device.
static bool has_lacking(const struct rg_baseline *made, const struct rg_baseline_making *how)
{
    bool any = how->is_lacking;
    for (int64_t i = 0; !any && i < made->count; i++)
        any = made->rows[i].outcome == RG_LACKING;
    return any;
}

static int write_it(const struct baseline_options *o, const struct rg_baseline *made)
{
    if (!rg_baseline_write(made, o->output))
        return rg_exit_of_error(); // a full disk is no regression
    printf("%s: %lld cells on %d device%s\n", o->output,
           (long long)(made->count / made->device_count), made->device_count,
           made->device_count == 1 ? "" : "s");
    return RG_EXIT_PASS;
}

// Writes the baseline. `left_out` is the enum rg_exit of devices that failed to open, and have no
// row.
static int keep(const struct baseline_options *o, const struct before *before,
                const struct rg_baseline *made, const struct rg_baseline_making *how, int left_out)
{
    print_keys(made);
    const int failures = print_failures(made);
    const bool is_there = before->is_there;
    const int changes = is_there ? rg_baseline_print_changes(&before->baseline, made, stdout) : 0;
    if (has_lacking(made, how)) {
        rg_error("%s: stays as it is, for raingauge itself lacked what some cells need; run this "
                 "again once it is there",
                 o->output);
        return rg_exit_worse(failures, RG_EXIT_HARNESS);
    }
    if (is_there && !changes) {
        printf("%s: nothing changes\n", o->output);
        return failures;
    }
    if (is_there && !o->update) {
        printf("%s: %d change%s; it is as it was: --update writes them\n", o->output, changes,
               changes == 1 ? "" : "s");
        return RG_EXIT_FAIL;
    }
    if (is_there && left_out != RG_EXIT_PASS) {
        rg_error("%s: stays as it is, for it would lose what it has of the device whose driver "
                 "fell; leave that out with --device",
                 o->output);
        return left_out;
    }
    if (!is_as_before(o->output, before))
        return RG_EXIT_FAIL;
    return rg_exit_worse(write_it(o, made), failures);
}

// --- the command ---

static int make(const struct baseline_options *o, const struct rg_gate_cells *cells,
                const struct before *before)
{
    const struct rg_baseline_request request = {.cells = cells,
                                                .launches = o->pictures_only ? 0 : o->launches};
    struct rg_baseline made = {.count = 0};
    struct rg_devices devices;
    struct rg_baseline_making how;
    int exit = rg_devices_open_asked(&o->devices, &devices);
    if (exit == RG_EXIT_PASS) {
        const int left_out = rg_devices_exit(&devices);
        if (rg_baseline_make(&request, &devices, &made, &how))
            exit = rg_exit_worse(rg_exit_worse(keep(o, before, &made, &how, left_out), left_out),
                                 how.has_failed ? RG_EXIT_FAIL : RG_EXIT_PASS);
        else
            exit =
                rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal() : rg_exit_of_error();
    }
    rg_baseline_free(&made);
    return exit;
}

static int baseline(const void *values, const struct rg_words *arguments)
{
    const struct baseline_options *o = values;
    struct rg_gate_cells cells = {.count = 0};
    struct before before = {.is_there = false};
    (void)arguments;
    rg_memory_allow(o->memory_bytes);
    const bool ok =
        (o->output || rg_error("baseline: name the file to write, as in `raingauge baseline -o "
                               "results/baseline.json`")) &&
        rg_sides_are_apart(o->devices.names) && rg_gate_cells_read(o->cells, &cells) &&
        look_before(o->output, &before);
    const int exit = ok ? make(o, &cells, &before) : rg_exit_of_error();
    rg_baseline_free(&before.baseline);
    rg_gate_cells_free(&cells);
    return exit;
}

const struct rg_command rg_command_baseline = {
    .name = "baseline",
    .reader = RG_FOR_DRIVERS,
    .usage = "-o FILE [--device D,...] [--cells FILE] [--launches N] [--update]",
    .about =
        "records what each cell of a gate draws, and how fast, for `raingauge gate --baseline`",
    .options = options,
    .options_size = sizeof(struct baseline_options),
    .run = baseline,
};
