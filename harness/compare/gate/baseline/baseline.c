#include "harness/compare/gate/baseline/baseline.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/text/add.h"
#include "harness/compare/text/shell.h"
#include "harness/devices/names.h"

// --- rows and devices ---

struct rg_baseline_row *rg_baseline_add(struct rg_baseline *baseline)
{
    if (!rg_array_fit(&baseline->rows, &baseline->room, baseline->count + 1,
                      sizeof(*baseline->rows), "baseline"))
        return NULL;
    struct rg_baseline_row *row = &baseline->rows[baseline->count++];
    *row = (struct rg_baseline_row){.outcome = RG_OK};
    return row;
}

const struct rg_baseline_row *rg_baseline_find(const struct rg_baseline *baseline, const char *cell,
                                               const char *device)
{
    for (int64_t i = 0; i < baseline->count; i++)
        if (!strcmp(baseline->rows[i].cell, cell) && !strcmp(baseline->rows[i].device, device))
            return &baseline->rows[i];
    return NULL;
}

const char *rg_baseline_state(const struct rg_baseline_row *row, const char *name)
{
    for (int i = 0; i < row->state_count; i++)
        if (!strcmp(row->states[i].name, name))
            return row->states[i].digest;
    return NULL;
}

const struct rg_baseline_device *rg_baseline_device(const struct rg_baseline *baseline,
                                                    const char *name)
{
    for (int i = 0; i < baseline->device_count; i++)
        if (!strcmp(baseline->devices[i].name, name))
            return &baseline->devices[i];
    return NULL;
}

void rg_baseline_free(struct rg_baseline *baseline)
{
    for (int i = 0; i < baseline->device_count; i++)
        json_decref(baseline->devices[i].parts);
    json_decref(baseline->passport);
    free(baseline->rows);
    *baseline = (struct rg_baseline){.count = 0};
}

// --- whether a baseline fits the cells ---

static bool is_named_by(const char *devices, const char *device)
{
    struct rg_device_name name;
    while (devices && *devices && rg_device_name_read(&devices, &name))
        if (!strcmp(name.name, device))
            return true;
    return false;
}

bool rg_baseline_asks(const char *devices, const char *device)
{
    return !devices || !strcmp(devices, "all") || is_named_by(devices, device);
}

static bool has_devices(const struct rg_baseline *baseline, const char *path, const char *devices)
{
    struct rg_device_name name;
    while (devices && strcmp(devices, "all") && *devices) {
        if (!rg_device_name_read(&devices, &name))
            return false;
        if (!rg_baseline_device(baseline, name.name))
            return rg_error("--device %s: %s has no such device; add it with `raingauge baseline "
                            "--update`",
                            name.name, path);
    }
    return true;
}

// Refuses, and names the option with all devices of the baseline, quoted for a shell.
static bool refuse_variables(const struct rg_baseline *baseline, const char *path, const char *name)
{
    enum { MOST_TOLD = 500 }; // keeps the line from being cut within quotes
    char names[MOST_TOLD + 1] = "", *word = NULL;
    size_t size;
    for (int i = 0; i < baseline->device_count; i++)
        rg_text_add(names, sizeof(names), ",", "%s", baseline->devices[i].name);
    FILE *out = open_memstream(&word, &size);
    if (out)
        rg_shell_word(out, names, strlen(names));
    if (out && !fclose(out))
        rg_error("%s: its device '%s' sets variables, which may start programs and drivers, so "
                 "that the command line has to name it; add --device %s",
                 path, name, strlen(word) < MOST_TOLD ? word : "with all that are to run");
    else
        rg_harness_error("%s: no memory for its devices; close other programs", path);
    free(word);
    return false;
}

// A file alone must not set variables, which could start a program or choose drivers and libraries:
// the user has to name such devices.
static bool sets_no_variables(const struct rg_baseline *baseline, const char *path,
                              const char *devices)
{
    for (int i = 0; i < baseline->device_count; i++) {
        const char *name = baseline->devices[i].name;
        if (strchr(name, '@') && rg_baseline_asks(devices, name) && !is_named_by(devices, name))
            return refuse_variables(baseline, path, name);
    }
    return true;
}

// Whether each row's cell exists, with the settings that it had.
static bool has_its_cells(const struct rg_baseline *baseline, const char *path,
                          const struct rg_gate_cells *cells, const char *cells_name)
{
    for (int64_t i = 0; i < baseline->count; i++) {
        const struct rg_baseline_row *row = &baseline->rows[i];
        const struct rg_gate_cell *cell = rg_gate_cells_find(cells, row->cell);
        char settings[RG_DIGEST_SIZE];
        if (!cell)
            return rg_error("%s: its cell '%s' is not in %s; take it out with `raingauge baseline "
                            "--update`",
                            path, row->cell, cells_name);
        rg_digest_of_cell(cell, settings);
        if (strcmp(settings, row->settings) != 0)
            return rg_error("%s: its cell '%s' has settings of digest %s, and that of %s:%d has "
                            "%s; name the cells that it was made of, or make it anew with "
                            "`raingauge baseline --update`",
                            path, row->cell, row->settings, cells_name, cell->line, settings);
    }
    return true;
}

bool rg_baseline_fits(const struct rg_baseline *baseline, const char *path,
                      const struct rg_gate_cells *cells, const char *cells_name,
                      const char *devices)
{
    if (!has_devices(baseline, path, devices) || !sets_no_variables(baseline, path, devices) ||
        !has_its_cells(baseline, path, cells, cells_name))
        return false;
    for (int64_t i = 0; i < cells->count; i++)
        for (int d = 0; d < baseline->device_count; d++)
            if (!rg_baseline_find(baseline, cells->cells[i].name, baseline->devices[d].name))
                return rg_error("%s: has no cell '%s' of %s:%d; add it with `raingauge baseline "
                                "--update`",
                                path, cells->cells[i].name, cells_name, cells->cells[i].line);
    return true;
}

// --- times ---

struct rg_gate_sample rg_baseline_sample(const struct rg_launches *launches)
{
    struct rg_gate_sample sample = {.count = launches->count};
    for (int i = 0; i < launches->count; i++)
        sample.logs[i] = log(launches->ms[i]);
    return sample;
}

double rg_launches_median(const struct rg_launches *launches)
{
    struct rg_launches sorted = *launches;
    return sorted.count ? rg_median(sorted.ms, sorted.count).median : NAN;
}

double rg_baseline_scatter(const struct rg_launches *launches)
{
    const struct rg_gate_rule rule = rg_gate_rule_apart(1);
    const struct rg_gate_sample sample = rg_baseline_sample(launches);
    return expm1(rg_gate_decide_apart(&rule, &sample, sample.logs, sample.count).spread);
}
