#include "harness/devices/measure/ceilings.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/device/device.h"
#include "harness/console/clock.h"
#include "kernels/probe/arithmetic_params.h"
#include "kernels/probe/copy_params.h"

enum { RUNS = 5, MIB = 1 << 20 };
enum { SMALL = MIB, MOST_SMALL = 16 * MIB, LARGE = 32 * MIB };
enum { MOST_LARGE_CPU = 128 * MIB, MOST_LARGE_GPU = 1024 * MIB };
enum { ITEMS = 1 << 17, MOST_ITEMS = 1 << 24 };

// A batch of runs takes so long, or has so many, that the wait after it hardly counts.
#define BATCH_MS 2
enum { MOST_BATCH = 256 };
// A rate stands if twice the work changes it by less than this.
#define STANDS 0.05

static bool time_batch(struct rg_pass *pass, const struct rg_run *run, int batch, double *ms)
{
    const double start_ms = rg_now_ms();
    for (int i = 0; i < batch; i++)
        if (!rg_pass_run(pass, run))
            return false;
    if (!rg_device_sync(pass->device))
        return false;
    *ms = (rg_now_ms() - start_ms) / batch;
    return true;
}

// The time of one run in milliseconds, from the fastest of several batches. The first run compiles.
static bool time_run(struct rg_pass *pass, const struct rg_run *run, double *best_ms)
{
    double ms = 0;
    int batch = 1;
    *best_ms = HUGE_VAL;
    if (!time_batch(pass, run, 1, &ms) || !time_batch(pass, run, 1, &ms))
        return false;
    while (batch * ms < BATCH_MS && batch < MOST_BATCH)
        batch *= 2;
    for (int i = 0; i < RUNS; i++) {
        if (!time_batch(pass, run, batch, &ms))
            return false;
        *best_ms = fmin(*best_ms, ms);
    }
    return true;
}

// The rate of a copy of this many bytes, read and written, in gigabytes a second.
static bool measure_copy(struct rg_device *device, int bytes, double *gb_s)
{
    void *zeroes = rg_alloc(1, (size_t)bytes, "ceiling source");
    struct rg_buf *source =
        zeroes ? rg_buf_create_with(device, zeroes, bytes, "ceiling source") : NULL;
    struct rg_buf *target = rg_buf_create(device, bytes, "ceiling target");
    struct rg_pass *copy = rg_pass_create(device, "probe_copy");
    const struct probe_copy_params params = {bytes / 4096, 1024, 0};
    double ms = 0;
    bool ok = source && target && copy &&
              time_run(copy,
                       &(struct rg_run){.params = &params,
                                        .slots = {[1].buf = source, [2].buf = target},
                                        .extent = {params.width, params.height, 1}},
                       &ms);
    *gb_s = ok ? 2.0 * bytes / ms * 1e-6 : 0;
    free(zeroes);
    rg_pass_destroy(copy);
    rg_buf_destroy(target);
    rg_buf_destroy(source);
    return ok;
}

static bool measure_arithmetic(struct rg_device *device, int items, double *gop_s)
{
    struct rg_buf *sums = rg_buf_create(device, (size_t)items * 4, "ceiling sums");
    struct rg_pass *pass = rg_pass_create(device, "probe_arithmetic");
    const struct probe_arithmetic_params params = {0.9999f, 1e-4f};
    double ms = 0;
    bool ok = sums && pass &&
              time_run(pass,
                       &(struct rg_run){
                           .params = &params, .slots = {[1].buf = sums}, .extent = {items, 1, 1}},
                       &ms);
    *gop_s = ok ? (double)items * PROBE_ARITHMETIC_OPS / ms * 1e-6 : 0;
    rg_pass_destroy(pass);
    rg_buf_destroy(sums);
    return ok;
}

// Doubles the work until the rate stands: a GPU needs more of it than a processor. `most` is in
// units of the work. If the work may leave a cache, the rate may fall; otherwise the best rate
// counts, and more work is tried only while the rate rises.
static bool measure_until_it_stands(struct rg_device *device, int work, int most, bool may_fall,
                                    bool (*measure)(struct rg_device *, int, double *),
                                    double *rate)
{
    double before = 0, now = 0;
    bool ok = measure(device, work, &now);
    *rate = now;
    while (ok && work <= most / 2 &&
           (now > before * (1 + STANDS) || (may_fall && now < before * (1 - STANDS)))) {
        before = now;
        work *= 2;
        ok = measure(device, work, &now);
        *rate = may_fall ? now : fmax(*rate, now);
    }
    return ok;
}

bool rg_ceilings_measure(struct rg_device *device, struct rg_ceilings *ceilings)
{
    const int64_t allowed = device->info.limits.max_buffer_bytes;
    const int wanted = device->info.software ? MOST_LARGE_CPU : MOST_LARGE_GPU;
    const int most = allowed < wanted ? (int)allowed : wanted;
    return measure_until_it_stands(device, LARGE, most, true, measure_copy,
                                   &ceilings->memory_gb_s) &&
           measure_until_it_stands(device, SMALL, MOST_SMALL, false, measure_copy,
                                   &ceilings->cache_gb_s) &&
           measure_until_it_stands(device, ITEMS, MOST_ITEMS, false, measure_arithmetic,
                                   &ceilings->arithmetic_gop_s);
}
