#include "harness/devices/measure/ceilings.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/device/device.h"
#include "harness/console/clock.h"
#include "kernels/probe/arithmetic_params.h"
#include "kernels/probe/copy_params.h"

enum { RUNS = 9, MIB = 1 << 20, LARGE = 64 * MIB, SMALL = MIB, ARITHMETIC_ITEMS = 1 << 17 };

// The time of one run in milliseconds, from the fastest of several batches.
static bool time_run(struct rg_pass *pass, const struct rg_run *run, int batch, double *best_ms)
{
    struct rg_device *device = pass->device;
    *best_ms = HUGE_VAL;
    for (int i = 0; i < RUNS; i++) {
        const double start_ms = rg_now_ms();
        for (int j = 0; j < batch; j++)
            if (!rg_pass_run(pass, run))
                return false;
        if (!rg_device_sync(device))
            return false;
        *best_ms = fmin(*best_ms, (rg_now_ms() - start_ms) / batch);
    }
    return true;
}

// The rate of a copy of this many bytes, read and written, in gigabytes a second.
static bool measure_copy(struct rg_device *device, int bytes, int batch, double *gb_s)
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
                       batch, &ms);
    *gb_s = ok ? 2.0 * bytes / ms * 1e-6 : 0;
    free(zeroes);
    rg_pass_destroy(copy);
    rg_buf_destroy(target);
    rg_buf_destroy(source);
    return ok;
}

static bool measure_arithmetic(struct rg_device *device, double *gop_s)
{
    struct rg_buf *sums = rg_buf_create(device, ARITHMETIC_ITEMS * 4, "ceiling sums");
    struct rg_pass *pass = rg_pass_create(device, "probe_arithmetic");
    const struct probe_arithmetic_params params = {0.9999f, 1e-4f};
    double ms = 0;
    bool ok = sums && pass &&
              time_run(pass,
                       &(struct rg_run){.params = &params,
                                        .slots = {[1].buf = sums},
                                        .extent = {ARITHMETIC_ITEMS, 1, 1}},
                       4, &ms);
    *gop_s = ok ? (double)ARITHMETIC_ITEMS * PROBE_ARITHMETIC_OPS / ms * 1e-6 : 0;
    rg_pass_destroy(pass);
    rg_buf_destroy(sums);
    return ok;
}

bool rg_ceilings_measure(struct rg_device *device, struct rg_ceilings *ceilings)
{
    return measure_copy(device, LARGE, 1, &ceilings->memory_gb_s) &&
           measure_copy(device, SMALL, 16, &ceilings->cache_gb_s) &&
           measure_arithmetic(device, &ceilings->arithmetic_gop_s);
}
