// Times each pass of a frame.
#include <math.h>
#include <string.h>

#include "core/base/stats.h"
#include "harness/console/clock.h"
#include "harness/devices/measure/measure.h"

enum { MOST_FRAMES = 40 };

// The time of each pass in each frame.
struct times {
    struct rg_record *record;
    int frame;
    double ms[RG_MAX_PASS_TIMES][MOST_FRAMES];
};

// With a limit of 0, one frame is measured.
static int least_frames(double passes_ms)
{
    return passes_ms > 0 ? 2 : 1;
}

// The index of a pass in the record.
static int pass_of(struct rg_record *record, const char *name)
{
    for (int i = 0; i < record->pass_count; i++)
        if (!strncmp(record->passes[i].name, name, RG_NAME_SIZE - 1))
            return i;
    if (record->pass_count == RG_MAX_PASS_TIMES)
        return RG_MAX_PASS_TIMES - 1;
    if (record->pass_count == RG_MAX_PASS_TIMES - 1)
        name = "other";
    struct rg_pass_time *pass = &record->passes[record->pass_count];
    *pass = (struct rg_pass_time){.ms = 0};
    rg_text_copy(pass->name, sizeof(pass->name), name);
    return record->pass_count++;
}

static void add_stage(const char *kernel, double ms, void *user)
{
    struct times *times = user;
    times->ms[pass_of(times->record, kernel)][times->frame] += ms;
}

// Ends after the frame in which the limit is reached. A pass has its median over the frames,
// because a disturbance of the machine in one frame would otherwise count as the pass's.
bool rg_job_time_passes(struct rg_job *job, double passes_ms)
{
    struct rg_record *record = job->record;
    struct times times = {.record = record};
    const double start = rg_now_ms();
    bool ok = true;
    while (ok && record->pass_frames < MOST_FRAMES &&
           (record->pass_frames < least_frames(passes_ms) || rg_now_ms() - start < passes_ms)) {
        times.frame = record->pass_frames++;
        ok = rg_job_be_ready(job, 1) && rg_session_stages(job->session, add_stage, &times);
    }
    for (int i = 0; i < record->pass_count; i++)
        record->passes[i].ms = rg_median(times.ms[i], record->pass_frames).median;
    return ok;
}

// A frame that waits after every stage takes longer than a normal one.
double rg_passes_expected_ms(double frame_ms, double passes_ms)
{
    const double ms = 1.5 * frame_ms;
    return ms * fmin(fmax(ceil(passes_ms / ms), least_frames(passes_ms)), MOST_FRAMES);
}
