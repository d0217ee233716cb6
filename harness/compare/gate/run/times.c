#include "harness/compare/gate/run/times.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/frames/session.h"
#include "harness/record/named.h"
#include "harness/record/stats.h"

// A launch takes so many quads: opening a cell costs as much as several, and what disturbs one of
// them is not in their median.
enum { QUADS = 3 };

bool rg_times_are_over(void *user)
{
    const struct rg_gate_times *t = user;
    return rg_interrupted() || (t->end_ms > 0 && rg_now_ms() >= t->end_ms);
}

bool rg_timed_cell_fails(struct rg_timed_cell *timed)
{
    const struct rg_failure failure = rg_failure_take();
    timed->outcome = failure.outcome == RG_UNSUPPORTED ? RG_ERROR : failure.outcome;
    timed->is_ours = failure.fault == RG_FAULT_INPUT || failure.fault == RG_FAULT_HARNESS;
    rg_text_copy(timed->why, sizeof(timed->why), failure.line);
    return false;
}

bool rg_times_launch(int number, void *user)
{
    struct rg_gate_times *t = user;
    const int first = number & 1; // neither is always the one that finds the machine idle
    int side = first;
    if (rg_side_launch(&t->sides[side]) && rg_side_launch(&t->sides[side = !first]))
        return true;
    for (int i = 0; i < t->cell_count; i++) {
        t->cells[i].side = side;
        rg_timed_cell_fails(&t->cells[i]);
    }
    return false;
}

// --- a cell's quad ---

// Frames that are not timed, for drivers compile in the first. By both sides' mean is settled how
// many are timed, the same on both: as a ratio, so that neither a slow one takes for ever nor a
// fast one is too short for the clock.
static bool warm_up(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES])
{
    double product = 1;
    for (int side = 0; side < RG_SIDES; side++) {
        double frame_ms;
        timed->side = side;
        if (!rg_slot_warm_up(sessions[side], &frame_ms))
            return false;
        product *= frame_ms;
    }
    if (!timed->slot.frames)
        rg_slot_settle(&timed->slot, sqrt(product));
    return true;
}

static bool time_quad(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES],
                      bool b_first, double times_ms[RG_SIDES][2])
{
    const int order[4] = {b_first, !b_first, !b_first, b_first};
    int taken[RG_SIDES] = {0, 0};
    for (int i = 0; i < 4; i++) {
        const int side = timed->side = order[i];
        if (!rg_slot_time(sessions[side], &timed->slot, &times_ms[side][taken[side]++]))
            return false;
    }
    return true;
}

static bool time_quads(struct rg_timed_cell *timed, struct rg_session *sessions[RG_SIDES],
                       bool b_first, struct rg_quads *quads)
{
    double logs[QUADS], all_ms[RG_SIDES][2 * QUADS];
    const struct rg_processor_time before = rg_processor_time();
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
                               .is_disturbed = rg_was_disturbed(&before)};
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
        const int side = timed->side = i ^ b_first;
        sessions[side] = rg_session_run(t->sides[side].device, &subject, cell->frames);
        ok = sessions[side] != NULL;
    }
    ok = (ok && warm_up(timed, sessions) && time_quads(timed, sessions, b_first, quads)) ||
         rg_timed_cell_fails(timed);
    for (int side = 0; side < RG_SIDES; side++)
        rg_session_close(sessions[side]);
    timed->seconds += (rg_now_ms() - start_ms) / 1000;
    return ok && !rg_interrupted();
}
