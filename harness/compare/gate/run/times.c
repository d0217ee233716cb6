#include "harness/compare/gate/run/times.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/frames/session.h"
#include "harness/record/stats.h"

// A timing lasts so long at least, and a place of a quad has as many as fill it, of which the
// median counts: where another process has a core, it takes it for some milliseconds at a time, and
// many short timings lie between, as few long ones do not. A launch takes so many quads: opening a
// cell costs as much as several, and what disturbs one of them is not in their median.
#define TIMING_MS 1
#define PLACE_MS  9
enum { LEAST_TIMINGS = 3, MOST_TIMINGS = 9, QUADS = 3, MOST_FRAMES = 1000 };
// Of the time of a quad, as much may go to others.
#define MOST_STOLEN 0.05

bool rg_times_are_over(void *user)
{
    const struct rg_gate_times *t = user;
    return rg_interrupted() || (t->end_ms > 0 && rg_now_ms() >= t->end_ms);
}

bool rg_times_launch(int number, void *user)
{
    struct rg_gate_times *t = user;
    const int first = number & 1; // neither is always the one that finds the machine idle
    t->has_failed = !rg_side_launch(&t->sides[first]) || !rg_side_launch(&t->sides[!first]);
    return !t->has_failed;
}

// --- time that went to others ---

struct processor_time {
    unsigned long long all, stolen;
};

// Of all processors together since the machine began; zeros where the kernel does not tell.
static struct processor_time read_processor_time(void)
{
    unsigned long long v[8] = {0};
    struct processor_time time = {0, 0};
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

static bool was_disturbed(const struct processor_time *before)
{
    const struct processor_time now = read_processor_time();
    return (double)(now.stolen - before->stolen) > MOST_STOLEN * (double)(now.all - before->all);
}

// --- a cell's quad ---

static bool fail(struct rg_timed_cell *timed)
{
    timed->outcome = rg_outcome_of_error();
    snprintf(timed->why, sizeof(timed->why), "%s", rg_last_error());
    return false;
}

// The time of a frame, by the median of some timings.
static bool time_place(const struct rg_timed_cell *timed, struct rg_session *session,
                       double *frame_ms)
{
    double timings_ms[MOST_TIMINGS];
    for (int i = 0; i < timed->timings; i++) {
        if (!rg_session_frames(session, timed->frames, &timings_ms[i]))
            return false;
        timings_ms[i] /= timed->frames;
    }
    *frame_ms = rg_median(timings_ms, timed->timings).median;
    return true;
}

// How many frames make a timing, and how many timings a place, where a frame takes so long.
static void settle(struct rg_timed_cell *timed, double frame_ms)
{
    frame_ms = fmax(frame_ms, 1e-6);
    timed->frames = (int)fmin(fmax(ceil(TIMING_MS / frame_ms), 1), MOST_FRAMES);
    timed->timings =
        (int)fmin(fmax(ceil(PLACE_MS / (timed->frames * frame_ms)), LEAST_TIMINGS), MOST_TIMINGS);
}

// Frames that are not timed, for drivers compile in the first. By both sides' mean is settled how
// many are timed, the same on both: as a ratio, so that neither a slow one takes for ever nor a
// fast one is too short for the clock.
static bool warm_up(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES])
{
    double product = 1;
    for (int side = 0; side < RG_SIDES; side++) {
        double ms;
        if (!rg_session_frames(sessions[side], 1, &ms) ||
            !rg_session_frames(sessions[side], 2, &ms))
            return false;
        product *= ms / 2;
    }
    if (!timed->frames)
        settle(timed, sqrt(product));
    return true;
}

static bool time_quad(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES],
                      bool b_first, double times_ms[RG_SIDES][2])
{
    const int order[4] = {b_first, !b_first, !b_first, b_first};
    int taken[RG_SIDES] = {0, 0};
    for (int i = 0; i < 4; i++) {
        const int side = order[i];
        if (!time_place(timed, sessions[side], &times_ms[side][taken[side]++]))
            return false;
    }
    return true;
}

static bool time_quads(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES],
                       bool b_first, struct rg_quads *quads)
{
    double logs[QUADS], all_ms[RG_SIDES][2 * QUADS];
    const struct processor_time before = read_processor_time();
    for (int i = 0; i < QUADS; i++) {
        double times_ms[RG_SIDES][2];
        if (!time_quad(timed, sessions, b_first ^ (i & 1), times_ms))
            return false;
        logs[i] = rg_quad_log(times_ms[RG_SIDE_A], times_ms[RG_SIDE_B]);
        for (int side = 0; side < RG_SIDES; side++)
            memcpy(&all_ms[side][2 * i], times_ms[side], sizeof(times_ms[side]));
    }
    *quads = (struct rg_quads){.log = rg_median(logs, QUADS).median,
                               .a_ms = rg_median(all_ms[RG_SIDE_A], 2 * QUADS).median,
                               .b_ms = rg_median(all_ms[RG_SIDE_B], 2 * QUADS).median,
                               .is_disturbed = was_disturbed(&before)};
    return true;
}

bool rg_times_take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    struct rg_gate_times *t = user;
    struct rg_timed_cell *timed = &t->cells[row];
    const struct rg_gate_cell *cell = timed->cell;
    const struct rg_subject subject = {cell->technique, cell->settings, cell->width, cell->height};
    struct rg_session *sessions[RG_SIDES] = {NULL, NULL};
    const double start_ms = rg_now_ms();
    bool ok = true;
    for (int i = 0; ok && i < RG_SIDES; i++) {
        const int side = i ^ b_first;
        sessions[side] = rg_session_run(t->sides[side].device, &subject, cell->frames);
        ok = sessions[side] != NULL;
    }
    ok = (ok && warm_up(timed, sessions) && time_quads(timed, sessions, b_first, quads)) ||
         fail(timed);
    for (int side = 0; side < RG_SIDES; side++)
        rg_session_close(sessions[side]);
    timed->seconds += (rg_now_ms() - start_ms) / 1000;
    return ok && !rg_interrupted();
}
