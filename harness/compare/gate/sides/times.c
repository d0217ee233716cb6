#include "harness/compare/gate/sides/times.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "core/base/log.h"
#include "core/base/stats.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/measure/others.h"
#include "harness/devices/measure/sampling.h"
#include "harness/record/record.h"

// A launch takes several blocks, or times of B alone. Opening a cell costs as much as several
// blocks, and a disturbance of one does not move their median.
enum { QUADS = 3 };

// How long all launches from this one to the first look take, or this one alone after that.
static double wait_ms(const struct rg_gate_times *t, int launch, double launch_ms)
{
    return launch_ms * (launch < t->first_look ? t->first_look - launch : 1);
}

// Whether the time has room for so much more of a cell; else the cell is over.
static bool has_room(struct rg_gate_times *t, struct rg_timed_cell *timed, double more_ms)
{
    const double now_ms = rg_now_ms();
    timed->is_over = t->end_ms > 0 && now_ms + more_ms >= t->end_ms;
    if (timed->is_over && t->launch < t->first_look)
        t->look_ms =
            fmax(t->look_ms, now_ms + wait_ms(t, t->launch, fmax(more_ms, now_ms - t->began_ms)));
    return !timed->is_over;
}

// The first launch is no measure of others, since drivers fill their caches in it.
bool rg_times_are_over(void *user)
{
    struct rg_gate_times *t = user;
    const double now_ms = rg_now_ms(), took_ms = t->is_launched ? now_ms - t->began_ms : 0;
    const double due_ms = now_ms + wait_ms(t, t->launch + 1, took_ms);
    if (t->launch + 1 < t->first_look)
        t->look_ms = fmax(t->look_ms, due_ms);
    return rg_interrupted() || (t->end_ms > 0 && (t->launch ? due_ms : now_ms) >= t->end_ms);
}

bool rg_timed_cell_fails(struct rg_timed_cell *timed)
{
    timed->outcome = rg_side_failure(&timed->is_ours, timed->why, sizeof(timed->why));
    if (timed->outcome == RG_UNSUPPORTED)
        timed->outcome = RG_ERROR;
    return false;
}

// --- launches ---

static void take_yardsticks(struct rg_gate_times *t)
{
    for (int i = 0; i < RG_YARDSTICKS; i++) {
        struct rg_launches *of = &t->yardsticks[i];
        const double ms = rg_yardstick_take(t->room, (enum rg_yardstick)i);
        if (of->count < RG_SHIFT_SAMPLES)
            of->ms[of->count++] = ms;
    }
}

static bool launch_pair(struct rg_gate_times *t, int first)
{
    int side = first;
    if (rg_side_launch(&t->sides[side]) && rg_side_launch(&t->sides[side = !first]))
        return true;
    for (int i = 0; i < t->cell_count; i++) {
        t->cells[i].side = side;
        rg_timed_cell_fails(&t->cells[i]);
    }
    return false;
}

// The sides of a pair take turns at being opened first, since the first one finds an idle machine.
// A side that runs alone is opened by the first of its rows, so that its failure harms no other.
static bool start(struct rg_gate_times *t)
{
    for (int side = 0; side < t->side_count; side++)
        rg_side_close(&t->sides[side]);
    if (t->room)
        take_yardsticks(t);
    t->began_ms = rg_now_ms();
    t->is_launched = !t->cells->sides[RG_SIDE_A] || launch_pair(t, t->launch & 1);
    t->failed = !t->is_launched;
    return t->is_launched;
}

// With a journal, processes are started only once something has to be timed.
bool rg_times_launch(int number, void *user)
{
    struct rg_gate_times *t = user;
    t->launch = number;
    t->is_launched = false;
    if (t->journal)
        rg_gate_journal_save(t->journal);
    return t->journal || start(t);
}

// --- one time of a side ---

// Least length of a timing, and of a slot, whose median counts. Another process takes a core for
// some milliseconds at a time; it misses many short timings, but few long ones. RG_FEW_SAMPLES
// takes the fewest timings.
#define TIMING_MS 1
#define SLOT_MS   9
enum { LEAST_TIMINGS = 3 };

// Runs frames that do not count, because drivers compile in the first; measures roughly how long
// one takes.
static bool warm_up_one(struct rg_session *session, double *frame_ms)
{
    double ms;
    const bool ok = rg_session_frames(session, 1, &ms) && rg_session_frames(session, 2, &ms);
    *frame_ms = ok ? ms / 2 : 0;
    return ok;
}

// Chooses the numbers of frames and timings for frames of this length.
static void settle(struct rg_slot *slot, double frame_ms)
{
    const double slot_ms = rg_sampling_few() ? 0 : SLOT_MS;
    frame_ms = fmax(frame_ms, 1e-6);
    slot->frames = (int)fmin(fmax(ceil(TIMING_MS / frame_ms), 1), RG_SLOT_FRAMES);
    slot->timings =
        (int)fmin(fmax(ceil(slot_ms / (slot->frames * frame_ms)), LEAST_TIMINGS), RG_SLOT_TIMINGS);
}

// The time of a frame: the median of the slot's timings.
static bool time_slot(struct rg_session *session, const struct rg_slot *slot, double *frame_ms)
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

// --- a cell's launch ---

// Runs frames that are not timed, because drivers compile in the first. Both sides get the same
// slot, chosen by the geometric mean of their frame times: short enough for a slow side, long
// enough for the clock on a fast one. False also if there is no room for it.
static bool warm_up(struct rg_gate_times *t, struct rg_timed_cell *timed,
                    struct rg_session *sessions[RG_SIDES])
{
    double frame_ms[RG_SIDES] = {0, 0};
    for (int side = 0; side < RG_SIDES; side++) {
        if (!sessions[side])
            continue;
        timed->side = side;
        if (!warm_up_one(sessions[side], &frame_ms[side]))
            return false;
    }
    if (!timed->slot.frames)
        settle(&timed->slot, sessions[RG_SIDE_A] ? sqrt(frame_ms[RG_SIDE_A] * frame_ms[RG_SIDE_B])
                                                 : frame_ms[RG_SIDE_B]);
    // A baseline may ask for many frames.
    const double frames_ms =
        sessions[RG_SIDE_A] ? 2 * (frame_ms[RG_SIDE_A] + frame_ms[RG_SIDE_B]) : frame_ms[RG_SIDE_B];
    return has_room(t, timed, QUADS * timed->slot.timings * timed->slot.frames * frames_ms);
}

static bool time_quad(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES],
                      bool b_first, double *const times_ms[RG_SIDES])
{
    const int order[4] = {b_first, !b_first, !b_first, b_first};
    int taken[RG_SIDES] = {0, 0};
    for (int i = 0; i < 4; i++) {
        const int side = timed->side = order[i];
        if (!time_slot(sessions[side], &timed->slot, &times_ms[side][taken[side]++]))
            return false;
    }
    return true;
}

// QUADS blocks of a pair, or as many times of B alone.
static bool time_launch(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES],
                        bool b_first, struct rg_quads *quads)
{
    double logs[QUADS], a_ms[2 * QUADS], b_ms[2 * QUADS];
    const bool is_pair = sessions[RG_SIDE_A];
    const struct rg_processors before = rg_processors_now(NULL, 0);
    for (int i = 0; i < QUADS; i++) {
        double *const at[RG_SIDES] = {a_ms + 2 * i, is_pair ? b_ms + 2 * i : b_ms + i};
        if (is_pair ? !time_quad(timed, sessions, b_first ^ (i & 1), at)
                    : !time_slot(sessions[RG_SIDE_B], &timed->slot, at[RG_SIDE_B]))
            return false;
        logs[i] = is_pair ? rg_block_log_ratio(at[RG_SIDE_A], at[RG_SIDE_B]) : 0;
    }
    // Only time that a hypervisor takes counts: other programs slow both sides.
    const struct rg_processors after = rg_processors_now(NULL, 0);
    *quads =
        (struct rg_quads){.b_ms = rg_median(b_ms, is_pair ? 2 * QUADS : QUADS).median,
                          .is_disturbed = rg_taken_between(&before, &after).stolen > RG_MOST_TAKEN};
    quads->a_ms = is_pair ? rg_median(a_ms, 2 * QUADS).median : 0;
    quads->log = is_pair ? rg_median(logs, QUADS).median : log(quads->b_ms);
    return true;
}

// Rests once several launches after each other were disturbed, twice as long after each, up to a
// second. A hypervisor takes its time in bursts, and launches of some milliseconds would all fall
// into one.
static void rest(struct rg_gate_times *t, bool is_disturbed)
{
    enum { BEFORE = 8, MOST = 7 };
    t->disturbed = is_disturbed ? t->disturbed + 1 : 0;
    if (t->disturbed <= BEFORE)
        return;
    const int doubled = t->disturbed - BEFORE - 1;
    const double left_ms = t->end_ms > 0 ? fmax(t->end_ms - rg_now_ms(), 0) : INFINITY;
    const double ms = fmin(doubled < MOST ? 10 << doubled : 1000, left_ms);
    nanosleep(&(struct timespec){(time_t)(ms / 1e3), (long)(1e6 * fmod(ms, 1e3))}, NULL);
}

static bool take(struct rg_gate_times *t, struct rg_timed_cell *timed, bool b_first,
                 struct rg_quads *quads)
{
    struct rg_session *sessions[RG_SIDES] = {NULL, NULL};
    const double start_ms = rg_now_ms();
    bool ok = true;
    for (int i = 0; ok && i < RG_SIDES; i++) {
        const int number = i ^ b_first;
        struct rg_side *side = timed->sides[number];
        if (!side)
            continue;
        timed->side = number;
        sessions[number] =
            side->device || rg_side_launch(side)
                ? rg_session_run(side->device, &timed->cell->subject, timed->cell->frames)
                : NULL;
        ok = sessions[number] != NULL;
    }
    ok = ok && warm_up(t, timed, sessions) && time_launch(timed, sessions, b_first, quads);
    if (!ok && !timed->is_over)
        rg_timed_cell_fails(timed);
    for (int side = 0; side < RG_SIDES; side++)
        rg_session_close(sessions[side]);
    if (ok)
        rest(t, quads->is_disturbed);
    timed->seconds += (rg_now_ms() - start_ms) / 1000;
    return ok && !rg_interrupted();
}

bool rg_times_take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    struct rg_gate_times *t = user;
    if (t->journal && rg_gate_journal_find(t->journal, t->cells[row].name, t->launch, quads))
        return true;
    if (!t->is_launched && (t->failed || !start(t)))
        return false;
    if (!has_room(t, &t->cells[row], 0) || !take(t, &t->cells[row], b_first, quads))
        return false;
    if (t->journal)
        rg_gate_journal_add(t->journal, t->cells[row].name, t->launch, quads);
    return true;
}
