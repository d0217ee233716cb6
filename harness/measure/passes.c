// What each pass of a frame takes.
#include <string.h>

#include "harness/console/clock.h"
#include "harness/measure/measure.h"

enum { MOST_FRAMES = 10, LEAST_FRAMES = 2 };

// The run ends with the frame in which it has taken so long.
#define PASSES_MS 400

struct pass_clock {
    struct rg_job *job;
    double last_ms;
    bool ok;
};

// Where the time of a pass is kept.
static struct rg_pass_time *pass_of(struct rg_record *record, const char *name)
{
    for (int i = 0; i < record->pass_count; i++)
        if (!strncmp(record->passes[i].name, name, RG_NAME_SIZE - 1))
            return &record->passes[i];
    if (record->pass_count == RG_MAX_PASS_TIMES)
        return &record->passes[RG_MAX_PASS_TIMES - 1];
    if (record->pass_count == RG_MAX_PASS_TIMES - 1)
        name = "other";
    struct rg_pass_time *pass = &record->passes[record->pass_count++];
    *pass = (struct rg_pass_time){.ms = 0};
    rg_text_copy(pass->name, sizeof(pass->name), name);
    return pass;
}

static void after_stage(const struct rg_opened_stage *stage, void *user)
{
    struct pass_clock *clock = user;
    clock->ok = rg_device_sync(clock->job->device) && clock->ok;
    const double now = rg_now_ms();
    pass_of(clock->job->record, stage->row.kernel)->ms += now - clock->last_ms;
    clock->last_ms = now;
}

bool rg_job_time_passes(struct rg_job *job)
{
    struct rg_record *record = job->record;
    const double start = rg_now_ms();
    struct pass_clock clock = {job, start, true};
    job->instance->after_stage = after_stage;
    job->instance->user = &clock;
    bool ok = true;
    while (ok && record->pass_frames < MOST_FRAMES &&
           (record->pass_frames < LEAST_FRAMES || rg_now_ms() - start < PASSES_MS)) {
        ok = rg_job_run(job, 1);
        record->pass_frames++;
    }
    job->instance->after_stage = NULL;
    for (int i = 0; i < record->pass_count; i++)
        record->passes[i].ms /= record->pass_frames;
    return ok && clock.ok;
}
