#include "harness/tables/sweep/plan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"
#include "harness/console/progress.h"
#include "harness/measure/expected.h"
#include "harness/devices/workers/device.h"
#include "harness/tables/measuring/measure.h"

// --- a row, opened for a moment ---

struct probe {
    double open_ms, frame_ms, bytes;
};

// The second frame is the one that is timed: drivers compile in the first.
static bool probe_settings(struct rg_device *device, const struct rg_subject *subject,
                           struct probe *probe)
{
    const double before = (double)rg_remote_held_bytes(device), start = rg_now_ms();
    struct rg_session *session = rg_session_run(device, subject, 1);
    if (!session)
        return false;
    const double opened = rg_now_ms();
    const bool ok = rg_session_frames(session, 1, &probe->frame_ms);
    probe->open_ms = opened - start;
    probe->bytes = fmax((double)rg_remote_held_bytes(device) - before, 0);
    rg_session_close(session);
    return ok;
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
    const bool ok = settings && probe_settings(device, &subject, probe);
    free(settings);
    free(of_row);
    free(defaults);
    return ok;
}

// --- what follows from two rows ---

// A value of a row between the first and the last, which go from one to the other by equal factors.
static double between(double first, double last, int row, int rows)
{
    const double share = rows > 1 ? row / (rows - 1.0) : 0;
    return first > 0 && last > 0 ? first * pow(last / first, share)
                                 : first + (last - first) * share;
}

// Opening, the frames before the image is compared, warming up, samples with a frame before each,
// and the passes told apart.
static double cell_ms(double open_ms, double frame_ms, int check_frames,
                      const struct rg_measure_options *o)
{
    const double sample_ms = fmax(o->sample_ms, frame_ms) + frame_ms;
    const double samples =
        fmin(fmax(floor(o->job_ms / sample_ms), o->least_samples), o->most_samples);
    const double warm_up_ms = fmax(4 * frame_ms, fmin(20 * frame_ms, o->warm_up_ms));
    return open_ms + check_frames * frame_ms + warm_up_ms + samples * sample_ms + 4 * frame_ms;
}

static void add_rows(const struct rg_table *table, const struct rg_measure_options *o,
                     const struct probe probes[2], int device, struct rg_plan *plan)
{
    const int frames = table->check_frames ? table->check_frames : RG_CHECK_FRAMES;
    for (int row = 0; row < plan->rows; row++) {
        const double open_ms = between(probes[0].open_ms, probes[1].open_ms, row, plan->rows);
        const double frame_ms = between(probes[0].frame_ms, probes[1].frame_ms, row, plan->rows);
        const double bytes = between(probes[0].bytes, probes[1].bytes, row, plan->rows);
        if (device < 0) {
            plan->check_s += (open_ms + frames * frame_ms) / 1000;
            continue;
        }
        plan->device_s[device] += cell_ms(open_ms, frame_ms, frames, o) / 1000;
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

// A device that fails is measured like the others, which tells how it does. False where the input
// is at fault, or no device is left.
static bool leave_out(struct rg_plan *plan, int device)
{
    plan->device_s[device] = NAN;
    plan->failed++;
    return rg_last_error_kind() != RG_ERROR_INPUT && plan->failed < plan->devices;
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

// --- telling ---

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
    rg_progress_told();
}
