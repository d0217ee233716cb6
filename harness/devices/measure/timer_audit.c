#include "harness/devices/measure/timer_audit.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/stats.h"
#include "core/device/device.h"
#include "harness/console/clock.h"
#include "kernels/probe/copy_params.h"

// Large enough to exceed the caches of one core, small enough for every device.
enum { SIDE = 1024, WORDS = SIDE * SIDE };
enum { REPETITIONS = 7, SYNCS = 51, DISPATCHES = 100, MAX_PASSES = 20000 };
static const double load_ns = 50e6;
static const double lowest_ratio = 0.8, highest_ratio = 1.05;

bool rg_timer_is_trusted(double ratio)
{
    return ratio >= lowest_ratio && ratio <= highest_ratio;
}

struct load {
    struct rg_device *device;
    struct rg_buf *source, *target;
    struct rg_pass *copy;
};

static bool load_init(struct load *load, struct rg_device *device)
{
    *load = (struct load){.device = device};
    uint32_t *words = rg_alloc(WORDS, 4, "timer source");
    bool ok = words &&
              (load->source = rg_buf_create_with(device, words, WORDS * 4, "timer source")) &&
              (load->target = rg_buf_create(device, WORDS * 4, "timer target")) &&
              (load->copy = rg_pass_create(device, "probe_copy"));
    free(words);
    return ok;
}

static void load_finish(struct load *load)
{
    rg_pass_destroy(load->copy);
    rg_buf_destroy(load->target);
    rg_buf_destroy(load->source);
}

static bool run(struct load *load, int passes, int side)
{
    const struct probe_copy_params params = {SIDE, SIDE, 1};
    struct rg_run one = {.params = &params, .extent = {side, side, 1}};
    one.slots[1].buf = load->source;
    one.slots[2].buf = load->target;
    for (int i = 0; i < passes; i++)
        if (!rg_pass_run(load->copy, &one))
            return false;
    return true;
}

// The wall time of `passes` between syncs.
static bool time_wall(struct load *load, int passes, int side, double *wall_ns)
{
    if (!rg_device_sync(load->device))
        return false;
    const double start_ms = rg_now_ms();
    if (!run(load, passes, side) || !rg_device_sync(load->device))
        return false;
    *wall_ns = (rg_now_ms() - start_ms) * 1e6;
    return true;
}

// The faster of two runs, so that one disturbance does not count.
static bool time_twice(struct load *load, int passes, double *wall_ns)
{
    double again_ns;
    if (!time_wall(load, passes, SIDE, wall_ns) || !time_wall(load, passes, SIDE, &again_ns))
        return false;
    *wall_ns = again_ns < *wall_ns ? again_ns : *wall_ns;
    return true;
}

// Finds the number of passes that makes the load long enough. The faster of two runs counts,
// because drivers compile in the first.
static bool calibrate(struct load *load, int *passes)
{
    double wall_ns;
    *passes = 1;
    while (time_twice(load, *passes, &wall_ns)) {
        if (wall_ns >= load_ns || *passes == MAX_PASSES)
            return true;
        // Short runs overestimate a pass, so the number grows at most 8 times before it is measured
        // again.
        double wanted = *passes * load_ns / (wall_ns > 1 ? wall_ns : 1) * 1.1 + 1;
        wanted = wanted > *passes * 8.0 ? *passes * 8.0 : wanted;
        *passes = wanted > MAX_PASSES ? MAX_PASSES : (int)wanted;
    }
    return false;
}

static bool audit_timer(struct load *load, struct rg_timer_audit *audit)
{
    double walls_ms[REPETITIONS], apis_ms[REPETITIONS], ratios[REPETITIONS];
    audit->has_timer = load->device->info.limits.has_clock;
    for (int i = 0; i < REPETITIONS; i++) {
        int64_t start = 0, end = 0;
        double wall_ns;
        if ((audit->has_timer && !rg_device_time(load->device, &start)) ||
            !time_wall(load, audit->passes, SIDE, &wall_ns) ||
            (audit->has_timer && !rg_device_time(load->device, &end)))
            return false;
        walls_ms[i] = wall_ns * 1e-6;
        apis_ms[i] = ((double)end - (double)start) * 1e-6;
        ratios[i] = apis_ms[i] / walls_ms[i];
    }
    audit->wall_ms = rg_median(walls_ms, REPETITIONS).median;
    if (!audit->has_timer)
        return true;
    audit->api_ms = rg_median(apis_ms, REPETITIONS).median;
    audit->ratio = rg_median(ratios, REPETITIONS).median;
    audit->trusted = rg_timer_is_trusted(audit->ratio);
    return true;
}

static bool audit_costs(struct load *load, struct rg_timer_audit *audit)
{
    double samples_ns[SYNCS];
    for (int i = 0; i < SYNCS; i++)
        if (!time_wall(load, 0, 1, &samples_ns[i]))
            return false;
    audit->sync_us = rg_median(samples_ns, SYNCS).median * 1e-3;
    for (int i = 0; i < SYNCS; i++)
        if (!time_wall(load, 1, 1, &samples_ns[i]))
            return false;
    audit->round_trip_us = rg_median(samples_ns, SYNCS).median * 1e-3;
    for (int i = 0; i < REPETITIONS; i++)
        if (!time_wall(load, DISPATCHES, 1, &samples_ns[i]))
            return false;
    audit->dispatch_us = rg_median(samples_ns, REPETITIONS).median * 1e-3 / DISPATCHES;
    return true;
}

bool rg_timer_audit(struct rg_device *device, struct rg_timer_audit *audit)
{
    *audit = (struct rg_timer_audit){0};
    struct load load;
    bool ok = load_init(&load, device) && calibrate(&load, &audit->passes) &&
              audit_timer(&load, audit) && audit_costs(&load, audit);
    load_finish(&load);
    return ok;
}
