#include "harness/tables/launching/launch.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/job.h"
#include "harness/devices/measure/others.h"
#include "harness/devices/measure/sampling.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/workers/worker.h"
#include "kernels/dialect/rng.h"

// A slot is the time of a cell's frame: the median of several timings of at least TIMING_MS,
// together of at least SLOT_MS. A group is timed there and back until that took GROUP_MS, long
// enough for the kernel's ticks to show the machine's load.
#define TIMING_MS 2
#define SLOT_MS   20
#define GROUP_MS  250
enum { LEAST_TIMINGS = 2, MOST_TIMINGS = 9, MOST_ROUNDS = 4, MOST_SLOTS = 2 * MOST_ROUNDS };

// A cell while its group is timed.
struct timed {
    struct rg_place at;
    struct rg_job job;
    struct rg_record scratch; // the job's outcome
    void *settings;           // owned
    double logs[MOST_SLOTS];
    int slots;
    double slot_ms, seconds;
};

struct launch {
    struct rg_result *result;
    const struct rg_table *table;
    int number;
    struct rg_device *device;
    int count;
    struct timed *timed; // owned; the cells of the group under way
    int *order;          // owned
    int64_t left;        // memory when the group began
    bool is_tight;       // not all of its cells can be open together
};

// --- chance ---

// Shuffled by launch and group, so that an interrupted run goes on as it would have.
static void shuffle(int *order, int count, int number, int group)
{
    for (int i = 0; i < count; i++)
        order[i] = i;
    for (int i = count - 1; i > 0; i--) {
        const uint bits = rg_random(2, (uint)number, (uint)group, (uint)i).x;
        const int j = (int)(bits % (uint)(i + 1)), kept = order[i];
        order[i] = order[j];
        order[j] = kept;
    }
}

// --- a slot ---

static bool make_ready(struct launch *l, struct timed *t)
{
    if (t->job.session)
        return true;
    if (!rg_job_be_ready(&t->job, 1))
        return false;
    rg_job_time(&t->job, 1); // drivers compile
    t->job.warm_frame_ms = t->scratch.outcome == RG_OK ? rg_job_time(&t->job, 1) : 0;
    l->is_tight = l->is_tight || rg_memory_left() < l->left / 2;
    return t->scratch.outcome == RG_OK;
}

static bool take_slot(struct launch *l, struct timed *t)
{
    double timings_ms[MOST_TIMINGS];
    if (!make_ready(l, t))
        return false;
    const double ms = fmax(t->job.warm_frame_ms, 1e-3);
    const int most = t->job.window_frames ? t->job.window_frames - 1 : 100000;
    const int frames = (int)fmin(fmax(ceil(TIMING_MS / ms), 1), most);
    const int timings = (int)fmin(fmax(ceil(SLOT_MS / (frames * ms)), LEAST_TIMINGS), MOST_TIMINGS);
    for (int i = 0; i < timings && t->scratch.outcome == RG_OK; i++) {
        if (!rg_job_be_ready(&t->job, frames + 1))
            return false;
        if (rg_sampling_has_run_up(ms))
            rg_job_time(&t->job, 1);
        timings_ms[i] = rg_job_time(&t->job, frames);
    }
    if (t->scratch.outcome != RG_OK || rg_interrupted())
        return false;
    t->logs[t->slots++] = log(rg_median(timings_ms, timings).median);
    t->slot_ms = timings * frames * ms;
    return true;
}

// Takes a slot of each cell in the order, or backward.
static bool go_through(struct launch *l, bool is_back)
{
    bool ok = true;
    for (int i = 0; ok && i < l->count; i++) {
        struct timed *t = &l->timed[l->order[is_back ? l->count - 1 - i : i]];
        const double start_ms = rg_now_ms();
        ok = take_slot(l, t);
        t->seconds += (rg_now_ms() - start_ms) / 1000;
        for (int k = 0; ok && l->is_tight && k < l->count; k++)
            if (&l->timed[k] != t)
                rg_job_close(&l->timed[k].job);
    }
    return ok;
}

static int rounds_of(const struct launch *l)
{
    double ms = 0;
    for (int i = 0; i < l->count; i++)
        ms += 2 * l->timed[i].slot_ms;
    return (int)fmin(fmax(ceil(GROUP_MS / ms), 1), MOST_ROUNDS);
}

// --- a group ---

static void keep(struct launch *l, const struct rg_taken *taken)
{
    for (int i = 0; i < l->count; i++) {
        struct timed *t = &l->timed[i];
        struct rg_record *record = rg_result_at(l->result, t->at);
        if (record->launch_count == RG_MAX_LAUNCHES)
            continue;
        record->launches[record->launch_count++] =
            (struct rg_launch){.number = l->number,
                               .ms = exp(rg_median(t->logs, t->slots).median),
                               .stolen = taken->stolen,
                               .others = taken->others,
                               .seconds = t->seconds};
        rg_record_settle(record);
    }
}

static bool time_group(struct launch *l)
{
    const struct rg_worker *worker = rg_remote_worker(l->device);
    const pid_t process = worker ? rg_worker_process(worker) : 0;
    const int our_count = process != 0;
    const struct rg_processors before = rg_processors_now(&process, our_count);
    bool ok = go_through(l, false) && go_through(l, true);
    for (int round = 1, rounds = ok ? rounds_of(l) : 0; ok && round < rounds; round++)
        ok = go_through(l, false) && go_through(l, true);
    const struct rg_processors after = rg_processors_now(&process, our_count);
    const struct rg_taken taken = rg_taken_between(&before, &after);
    if (ok)
        keep(l, &taken);
    for (int i = 0; !ok && !rg_interrupted() && i < l->count; i++)
        if (l->timed[i].scratch.outcome != RG_OK)
            rg_warning("%s: launch %d of row %d on %s failed: %s", l->table->id, l->number,
                       l->timed[i].at.row + 1, l->device->info.name, l->timed[i].scratch.detail);
    return ok;
}

static bool add_cell(struct launch *l, struct rg_place at)
{
    struct timed *t = &l->timed[l->count++];
    *t = (struct timed){.at = at, .settings = rg_table_settings(l->result, l->table, at)};
    t->job = (struct rg_job){.subject = {rg_technique_find(l->table->technique), t->settings,
                                         l->table->width, l->table->height},
                             .device = l->device,
                             .check_frames = l->result->check_frames,
                             .window_frames = l->table->window_frames,
                             .record = &t->scratch};
    return t->settings;
}

static bool take_group(struct launch *l, const struct rg_launch_cells *cells, int group)
{
    bool ok = true;
    l->count = 0;
    l->is_tight = false;
    l->left = rg_memory_left();
    for (int i = 0; ok && i < cells->count; i++)
        if (cells->cells[i].group == group)
            ok = add_cell(l, cells->cells[i].at);
    shuffle(l->order, l->count, l->number, group + 1);
    ok = ok && time_group(l);
    for (int i = 0; i < l->count; i++) {
        rg_job_close(&l->timed[i].job);
        free(l->timed[i].settings);
    }
    return ok;
}

bool rg_launch_take(struct rg_result *result, const struct rg_table *table,
                    const struct rg_launch_cells *cells, int number)
{
    struct launch l = {.result = result, .table = table, .number = number};
    int *groups = rg_alloc((size_t)cells->group_count, sizeof(*groups), table->id);
    l.timed = rg_alloc((size_t)cells->count, sizeof(*l.timed), table->id);
    l.order = rg_alloc((size_t)cells->count, sizeof(*l.order), table->id);
    bool ok = groups && l.timed && l.order;
    l.device = ok ? rg_devices_open_one(result->devices[cells->cells[0].at.device].name) : NULL;
    ok = l.device != NULL;
    if (ok)
        shuffle(groups, cells->group_count, number, 0);
    for (int i = 0; ok && i < cells->group_count; i++)
        ok = take_group(&l, cells, groups[i]);
    if (l.device)
        ok = rg_device_close(l.device) && ok;
    free(l.order);
    free(l.timed);
    free(groups);
    return ok;
}
