// What each pass of a frame takes.
#include <math.h>
#include <string.h>

#include "harness/console/clock.h"
#include "harness/measure/measure.h"

enum { MOST_FRAMES = 10 };

// Of a run that may take no time one frame tells.
static int least_frames(double passes_ms)
{
    return passes_ms > 0 ? 2 : 1;
}

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

static void add_stage(const char *kernel, double ms, void *user)
{
    pass_of(user, kernel)->ms += ms;
}

// The run ends with the frame in which it has taken so long.
bool rg_job_time_passes(struct rg_job *job, double passes_ms)
{
    struct rg_record *record = job->record;
    const double start = rg_now_ms();
    bool ok = true;
    while (ok && record->pass_frames < MOST_FRAMES &&
           (record->pass_frames < least_frames(passes_ms) || rg_now_ms() - start < passes_ms)) {
        ok = rg_job_be_ready(job, 1) && rg_session_stages(job->session, add_stage, record);
        record->pass_frames++;
    }
    for (int i = 0; i < record->pass_count; i++)
        record->passes[i].ms /= record->pass_frames;
    return ok;
}

// A frame that waits after every stage takes longer than one that does not.
double rg_passes_expected_ms(double frame_ms, double passes_ms)
{
    const double ms = 1.5 * frame_ms;
    return ms * fmin(fmax(ceil(passes_ms / ms), least_frames(passes_ms)), MOST_FRAMES);
}
