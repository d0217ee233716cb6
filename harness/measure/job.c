#include "harness/measure/job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/frames/frame.h"

enum { MAX_WARM_UP_FRAMES = 20, MIN_WARM_UP_FRAMES = 4 };

bool rg_job_run(struct rg_job *job, int frames)
{
    bool ok = true;
    for (int i = 0; ok && i < frames && !rg_interrupted(); i++)
        ok = job->technique->step(job->instance) && job->technique->draw(job->instance);
    return ok && rg_device_sync(job->device);
}

double rg_job_time(struct rg_job *job, int frames)
{
    const double start = rg_now_ms();
    if (!rg_job_run(job, frames))
        rg_record_end_by_error(job->record);
    return (rg_now_ms() - start) / frames;
}

// --- preparing: open, check, warm up ---

static bool open_instance(struct rg_job *job)
{
    const double start = rg_now_ms();
    job->instance =
        rg_instance_open(job->technique, job->device, job->settings, job->width, job->height);
    if (!job->instance || !rg_device_sync(job->device))
        return rg_record_end_by_error(job->record);
    const double opened = rg_now_ms();
    if (!rg_job_run(job, 1))
        return rg_record_end_by_error(job->record);
    job->record->create_ms = opened - start;
    job->record->first_frame_ms = rg_now_ms() - opened;
    return true;
}

static void keep_told(struct rg_record *record, const struct rg_instance *instance)
{
    record->counter_count = instance->counter_count;
    record->fact_count = instance->fact_count;
    rg_counters_copy(record->counters, instance->counters, instance->counter_count);
    rg_facts_copy(record->facts, instance->facts, instance->fact_count);
}

bool rg_job_open(struct rg_job *job)
{
    job->record->outcome = RG_OK;
    if (!open_instance(job))
        return false;
    job->warm_frame_ms = job->record->first_frame_ms;
    if (job->check_frames > 1)
        job->warm_frame_ms = rg_job_time(job, job->check_frames - 1);
    keep_told(job->record, job->instance);
    return job->record->outcome == RG_OK;
}

// Whether an image holds tier T1, which other drivers than the software ones are held to.
static bool holds_t1(struct rg_job *job, const struct rg_expected *expected, const void *texels)
{
    struct rg_picture picture = {0};
    struct rg_comparison comparison = {0};
    const struct rg_picture *dry = expected->dry.texels ? &expected->dry : NULL;
    bool ok = rg_frame_picture(job->instance, texels, &picture) &&
              rg_compare(&expected->picture, "cpu:reference", &picture, job->device->info.name, dry,
                         &(struct rg_compare_options){0}, &comparison);
    bool holds = ok && comparison.tiers.of[RG_T1].holds;
    if (!holds)
        rg_record_end(job->record, ok ? RG_FAIL : RG_ERROR,
                      ok ? comparison.tiers.of[RG_T1].why : rg_last_error());
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&picture);
    return holds;
}

static bool agrees(struct rg_job *job, const struct rg_expected *expected, const void *texels)
{
    if (!memcmp(expected->texels, texels, expected->size))
        return true;
    if (!job->device->info.software)
        return holds_t1(job, expected, texels);
    return rg_record_end(
        job->record, RG_FAIL,
        "its image differs from cpu:reference's (T0); `raingauge diff` shows where");
}

bool rg_job_check(struct rg_job *job, const struct rg_expected *expected)
{
    size_t size;
    void *texels = rg_frame_read(job->instance, &size);
    const bool ok = texels && size == expected->size ? agrees(job, expected, texels)
                                                     : rg_record_end_by_error(job->record);
    free(texels);
    return ok;
}

// Until two frames in a row take the same time to 10 %: drivers go on compiling for a while. The
// check frames have begun it.
bool rg_job_warm_up(struct rg_job *job, const struct rg_measure_options *options)
{
    const double start = rg_now_ms();
    for (int i = 1; i <= MAX_WARM_UP_FRAMES && job->record->outcome == RG_OK; i++) {
        const double before = job->warm_frame_ms, now = rg_job_time(job, 1);
        job->warm_frame_ms = now;
        const bool settled = i >= MIN_WARM_UP_FRAMES && fabs(now - before) <= 0.1 * before;
        if (settled || rg_now_ms() - start > options->warm_up_ms)
            break;
    }
    return job->record->outcome == RG_OK;
}

void rg_job_close(struct rg_job *job)
{
    if (job->instance)
        rg_instance_close(job->instance);
    job->instance = NULL;
}
