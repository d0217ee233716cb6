#include "harness/compare/gate/run/slot.h"

#include <math.h>
#include <stdio.h>

#include "harness/record/stats.h"

// A timing lasts so long at least, and a slot has as many as fill it, of which the median counts:
// where another process has a core, it takes it for some milliseconds at a time, and many short
// timings lie between, as few long ones do not.
#define TIMING_MS 1
#define SLOT_MS   9
enum { LEAST_TIMINGS = 3 };
// As much of the time may go to others.
#define MOST_STOLEN 0.05

struct rg_processor_time rg_processor_time(void)
{
    unsigned long long v[8] = {0};
    struct rg_processor_time time = {0, 0};
    FILE *file = fopen("/proc/stat", "r");
    if (file && fscanf(file, "cpu %llu %llu %llu %llu %llu %llu %llu %llu", &v[0], &v[1], &v[2],
                       &v[3], &v[4], &v[5], &v[6], &v[7]) == 8) {
        for (int i = 0; i < 8; i++)
            time.all += v[i];
        time.stolen = v[7];
    }
    if (file)
        fclose(file);
    return time;
}

bool rg_was_disturbed(const struct rg_processor_time *before)
{
    const struct rg_processor_time now = rg_processor_time();
    return (double)(now.stolen - before->stolen) > MOST_STOLEN * (double)(now.all - before->all);
}

bool rg_slot_warm_up(struct rg_session *session, double *frame_ms)
{
    double ms;
    const bool ok = rg_session_frames(session, 1, &ms) && rg_session_frames(session, 2, &ms);
    *frame_ms = ok ? ms / 2 : 0;
    return ok;
}

void rg_slot_settle(struct rg_slot *slot, double frame_ms)
{
    frame_ms = fmax(frame_ms, 1e-6);
    slot->frames = (int)fmin(fmax(ceil(TIMING_MS / frame_ms), 1), RG_SLOT_FRAMES);
    slot->timings =
        (int)fmin(fmax(ceil(SLOT_MS / (slot->frames * frame_ms)), LEAST_TIMINGS), RG_SLOT_TIMINGS);
}

bool rg_slot_time(struct rg_session *session, const struct rg_slot *slot, double *frame_ms)
{
    double timings_ms[RG_SLOT_TIMINGS];
    for (int i = 0; i < slot->timings; i++) {
        if (!rg_session_frames(session, slot->frames, &timings_ms[i]))
            return false;
        timings_ms[i] /= slot->frames;
    }
    *frame_ms = rg_median(timings_ms, slot->timings).median;
    return true;
}
