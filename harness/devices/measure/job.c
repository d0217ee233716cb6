#include "harness/devices/measure/job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/device/device.h"
#include "harness/console/clock.h"
#include "harness/devices/frames/frame.h"

enum { MAX_WARM_UP_FRAMES = 20 };

double rg_job_time(struct rg_job *job, int frames)
{
    double wall_ms = 0;
    if (!rg_session_frames(job->session, frames, &wall_ms))
        rg_record_end_by_error(job->record);
    return wall_ms / frames;
}

static bool is_in_window(const struct rg_job *job, int frames)
{
    struct rg_account told;
    if (!job->window_frames)
        return true;
    return rg_session_tell(job->session, &told) &&
           told.frame + frames <= job->check_frames + job->window_frames;
}

bool rg_job_be_ready(struct rg_job *job, int frames)
{
    if (job->session && rg_session_lives(job->session) && is_in_window(job, frames))
        return true;
    rg_session_close(job->session);
    job->session = rg_session_run(job->device, &job->subject, job->check_frames);
    return job->session || rg_record_end_by_error(job->record);
}

// --- preparing: open, check, warm up ---

static bool open_session(struct rg_job *job)
{
    const double start = rg_now_ms();
    job->session = rg_session_open(job->device, &job->subject);
    if (!job->session || !rg_session_sync(job->session))
        return rg_record_end_by_error(job->record);
    job->record->create_ms = rg_now_ms() - start;
    if (!rg_session_frames(job->session, 1, &job->record->first_frame_ms))
        return rg_record_end_by_error(job->record);
    return true;
}

static bool keep_told(struct rg_record *record, const struct rg_session *session)
{
    struct rg_account told;
    if (!rg_session_tell(session, &told))
        return rg_record_end_by_error(record);
    record->counter_count = told.counter_count;
    record->fact_count = told.fact_count;
    rg_counters_copy(record->counters, told.counters, told.counter_count);
    rg_facts_copy(record->facts, told.facts, told.fact_count);
    return true;
}

// Frames before the last are not drawn, as for the expected image, because drawing does not change
// the state.
static bool simulate(struct rg_job *job)
{
    const int frames = job->check_frames - 2;
    bool ok = true;
    for (int i = 0; ok && i < frames; i++)
        ok = rg_session_step(job->session);
    return (ok && (frames < 1 || rg_session_sync(job->session))) ||
           rg_record_end_by_error(job->record);
}

bool rg_job_open(struct rg_job *job)
{
    job->record->outcome = RG_OK;
    if (!open_session(job) || !simulate(job))
        return false;
    job->warm_frame_ms = job->record->first_frame_ms;
    if (job->check_frames > 1)
        job->warm_frame_ms = rg_job_time(job, 1);
    return job->record->outcome == RG_OK && keep_told(job->record, job->session);
}

// Whether an image that is not identical still meets the device's tier.
static bool holds(struct rg_job *job, const struct rg_expected *expected, const void *texels,
                  enum rg_tier tier)
{
    struct rg_picture picture = {0};
    struct rg_comparison comparison = {0};
    const struct rg_picture *dry = expected->dry.texels ? &expected->dry : NULL;
    const bool ok =
        rg_session_picture(job->session, texels, &picture) &&
        rg_frame_compare(job->device, &job->subject, job->check_frames, &expected->device,
                         &expected->picture, dry, &picture, &comparison);
    const struct rg_verdict *verdict = &comparison.tiers.of[tier];
    if (!ok)
        rg_record_end_by_error(job->record);
    else if (!verdict->holds)
        rg_record_end(job->record, RG_FAIL, verdict->why);
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&picture);
    return job->record->outcome == RG_OK;
}

static bool agrees(struct rg_job *job, const struct rg_expected *expected, const void *texels)
{
    const enum rg_tier tier = rg_tier_owed(&job->device->info, &expected->device);
    if (!memcmp(expected->texels, texels, expected->size))
        return true;
    if (tier != RG_T0)
        return holds(job, expected, texels, tier);
    return rg_record_end(
        job->record, RG_FAIL,
        "its image differs from cpu:reference's (T0); `raingauge diff` shows where");
}

bool rg_job_check(struct rg_job *job, const struct rg_expected *expected)
{
    size_t size;
    void *texels = rg_session_read(job->session, &size);
    const bool ok = texels && size == expected->size ? agrees(job, expected, texels)
                                                     : rg_record_end_by_error(job->record);
    free(texels);
    return ok;
}

static int64_t count_of(const struct rg_account *account, const char *name)
{
    for (int i = 0; i < account->counter_count; i++)
        if (!strcmp(account->counters[i].name, name))
            return account->counters[i].value;
    return 0;
}

// Stores how much the requested counters have grown since `before`.
static bool keep_counted(struct rg_job *job, const struct rg_account *before)
{
    struct rg_record *record = job->record;
    struct rg_account now;
    if (!rg_session_tell(job->session, &now))
        return rg_record_end_by_error(record);
    record->counted_count = 0;
    for (const char *const *name = job->counted; name && *name; name++) {
        struct rg_count *count = &record->counted[record->counted_count++];
        rg_text_copy(count->name, sizeof(count->name), *name);
        count->value = count_of(&now, *name) - count_of(before, *name);
    }
    return true;
}

bool rg_job_count(struct rg_job *job)
{
    struct rg_account before;
    job->record->has_tally = rg_session_tell(job->session, &before) &&
                             rg_session_count(job->session, &job->record->tally);
    if (!job->record->has_tally)
        return rg_record_end_by_error(job->record);
    return keep_counted(job, &before);
}

// Runs until two successive frames take the same time to 10 %, because drivers compile for a while
// even after the check frames.
bool rg_job_warm_up(struct rg_job *job, const struct rg_measure_options *options)
{
    const double start = rg_now_ms();
    for (int i = 1; i <= MAX_WARM_UP_FRAMES && job->record->outcome == RG_OK; i++) {
        if (!rg_job_be_ready(job, 1))
            return false;
        const double before = job->warm_frame_ms, now = rg_job_time(job, 1);
        job->warm_frame_ms = now;
        const bool settled = i >= options->warm_up_frames && fabs(now - before) <= 0.1 * before;
        if (settled || rg_now_ms() - start > options->warm_up_ms)
            break;
    }
    return job->record->outcome == RG_OK;
}

void rg_job_close(struct rg_job *job)
{
    rg_session_close(job->session);
    job->session = NULL;
}
