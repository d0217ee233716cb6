#include "harness/tables/own/estimate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/console/duration.h"
#include "harness/devices/workers/device.h"
#include "harness/tables/measuring/cell.h"
#include "harness/tables/measuring/measure.h"

// --- a row that is opened for a moment ---

struct probe {
    struct rg_cell_frames frames;
    double bytes;
};

static bool probe_settings(struct rg_device *device, const struct rg_subject *subject, int steps,
                           struct probe *probe)
{
    const double before = (double)rg_remote_held_bytes(device);
    struct rg_session *session = rg_cell_look(device, subject, steps, &probe->frames);
    if (!session)
        return false;
    probe->bytes = fmax((double)rg_remote_held_bytes(device) - before, 0);
    rg_session_close(session);
    return true;
}

static bool probe_row(const struct rg_table *table, const char *set, int row,
                      struct rg_device *device, struct probe *probe)
{
    const struct rg_technique *technique = rg_technique_find(table->technique);
    void *defaults = rg_settings_create(technique), *of_row = NULL, *settings = NULL;
    if (defaults)
        of_row = rg_settings_copy(technique, defaults, table->rows[row].set);
    if (of_row)
        settings = rg_settings_copy(technique, of_row, set ? set : "");
    const struct rg_subject subject = {technique, settings, table->width, table->height};
    const bool ok = settings && probe_settings(device, &subject, rg_cell_steps(table), probe);
    free(settings);
    free(of_row);
    free(defaults);
    return ok;
}

// --- estimates from two rows ---

// Interpolates between the first and the last row, geometrically if both values are positive.
static double between(double first, double last, int row, int rows)
{
    const double share = rows > 1 ? row / (rows - 1.0) : 0;
    return first > 0 && last > 0 ? first * pow(last / first, share)
                                 : first + (last - first) * share;
}

static void add_rows(const struct rg_table *table, const struct rg_measure_options *o,
                     const struct probe probes[2], int device, struct rg_plan *plan)
{
    for (int row = 0; row < plan->rows; row++) {
        const struct rg_cell_frames *first = &probes[0].frames, *last = &probes[1].frames;
        const struct rg_cell_frames frames = {
            between(first->open_ms, last->open_ms, row, plan->rows),
            between(first->step_ms, last->step_ms, row, plan->rows),
            between(first->frame_ms, last->frame_ms, row, plan->rows)};
        const double bytes = between(probes[0].bytes, probes[1].bytes, row, plan->rows);
        if (device < 0) {
            plan->check_s += rg_cell_image_ms(table, &frames) / 1000;
            continue;
        }
        plan->device_s[device] += rg_cell_ms(table, &frames, o) / 1000;
        plan->all_bytes += bytes;
    }
    if (device >= 0)
        plan->row_bytes += fmax(probes[0].bytes, probes[1].bytes);
}

static bool probe_device(const struct rg_table *table, const char *set, struct rg_device *device,
                         struct probe probes[2])
{
    const int last = table->row_count - 1;
    if (!device || !probe_row(table, set, 0, device, &probes[0]))
        return false;
    probes[1] = probes[0];
    return !last || probe_row(table, set, last, device, &probes[1]);
}

// Leaves out a device that fails; measuring it will report the failure. False if the input is at
// fault, or if no device is left.
static bool leave_out(struct rg_plan *plan, int device)
{
    plan->device_s[device] = NAN;
    plan->failed++;
    return rg_failure_take().fault != RG_FAULT_INPUT && plan->failed < plan->devices;
}

bool rg_plan_make(const struct rg_table *table, const char *set, bool is_full, struct rg_kept *kept,
                  struct rg_plan *plan)
{
    const struct rg_measure_options *options = rg_table_options(is_full);
    bool has_reference = false;
    struct probe probes[2];
    *plan = (struct rg_plan){.rows = table->row_count, .devices = kept->devices->count};
    for (int d = 0; d < plan->devices; d++) {
        struct rg_device *device = kept->devices->devices[d];
        has_reference = has_reference || !strcmp(device->info.name, "cpu:reference");
        if (probe_device(table, set, device, probes))
            add_rows(table, options, probes, d, plan);
        else if (!leave_out(plan, d))
            return false;
    }
    if (has_reference)
        return true;
    if (!probe_device(table, set, rg_kept_device(kept, "cpu:reference"), probes))
        return false;
    add_rows(table, options, probes, -1, plan);
    return true;
}

// --- printing ---

static void print_duration(double s, FILE *out)
{
    char text[RG_DURATION_TEXT];
    fputs(isnan(s) ? "not known" : rg_duration_text(s, text), out);
}

void rg_plan_print(const struct rg_plan *plan, const struct rg_devices *devices, FILE *out)
{
    double total = plan->check_s;
    fprintf(out, "plan: %d rows on ", plan->rows);
    for (int d = 0; d < plan->devices; d++) {
        fprintf(out, "%s%s", d ? ", " : "", devices->devices[d]->info.name);
        total += isnan(plan->device_s[d]) ? 0 : plan->device_s[d];
    }
    fprintf(out, ", %d cells; about ", plan->rows * plan->devices);
    print_duration(total, out);
    fprintf(out, " (");
    for (int d = 0; d < plan->devices; d++) {
        fprintf(out, "%s%s ", d ? ", " : "", devices->devices[d]->info.name);
        print_duration(plan->device_s[d], out);
    }
    if (plan->check_s > 0) {
        fprintf(out, ", images to check by ");
        print_duration(plan->check_s, out);
    }
    const bool all = plan->all_bytes <= (double)rg_memory_left() / 2;
    fprintf(out, "), about %.0f MB%s\n", (all ? plan->all_bytes : plan->row_bytes) / 1e6,
            all ? " with all rows open in turn"
                : " a row, of which as many are open as memory holds");
}
