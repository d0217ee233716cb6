#include "harness/compare/gate/baseline/take.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "harness/compare/gate/run/slot.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/frames/frame.h"

static struct rg_subject subject_of(const struct rg_gate_cell *cell)
{
    return (struct rg_subject){cell->technique, cell->settings, cell->width, cell->height};
}

// --- what is the same every time ---

static bool take_picture(struct rg_session *session, struct rg_baseline_row *row,
                         struct rg_picture *picture)
{
    size_t size;
    void *texels = rg_session_read(session, &size);
    if (texels)
        rg_digest_of(texels, size, row->picture);
    const bool ok = texels && rg_session_picture(session, texels, picture);
    free(texels);
    return ok;
}

static bool take_states(struct rg_session *session, struct rg_baseline_row *row)
{
    for (int i = 0; i < rg_session_state_count(session); i++) {
        struct rg_baseline_state *state = &row->states[row->state_count++];
        struct rg_state layout;
        size_t size;
        void *words = rg_session_read_state(session, i, &layout, &size);
        if (!words)
            return false;
        rg_text_copy(state->name, sizeof(state->name), layout.name);
        rg_digest_of(words, size, state->digest);
        free(words);
    }
    return true;
}

// Its counters, and the work of one frame more.
static bool take_work(struct rg_session *session, struct rg_baseline_row *row)
{
    struct rg_account told;
    if (!rg_session_tell(session, &told))
        return false;
    row->counters.count = told.counter_count;
    rg_counters_copy(row->counters.counters, told.counters, told.counter_count);
    return rg_session_count(session, &row->work);
}

void rg_baseline_take(const struct rg_gate_cell *cell, struct rg_device *device,
                      struct rg_baseline_row *row, struct rg_picture *picture)
{
    const struct rg_subject subject = subject_of(cell);
    snprintf(row->cell, sizeof(row->cell), "%s", cell->name);
    snprintf(row->technique, sizeof(row->technique), "%s", cell->technique->name);
    snprintf(row->device, sizeof(row->device), "%s", device->info.name);
    rg_digest_of_cell(cell, row->settings);
    *picture = (struct rg_picture){0};
    struct rg_session *session = rg_session_run(device, &subject, cell->frames);
    if (!session || !take_picture(session, row, picture) || !take_states(session, row) ||
        !take_work(session, row) || !rg_session_code(session, &row->code)) {
        const struct rg_failure failure = rg_failure_take();
        row->outcome = failure.outcome;
        row->is_ours = failure.fault == RG_FAULT_INPUT || failure.fault == RG_FAULT_HARNESS;
        rg_text_copy(row->why, sizeof(row->why), failure.line);
        rg_picture_destroy(picture);
    }
    rg_session_close(session);
}

// --- the truth ---

static const char truth_name[] = "cpu:reference";

bool rg_truth_open(struct rg_truth *truth)
{
    if (!truth->device)
        truth->device = rg_devices_open_one(truth_name);
    return truth->device != NULL;
}

bool rg_truth_holds(struct rg_truth *truth, const struct rg_gate_cell *cell,
                    const struct rg_device *device, const struct rg_picture *picture,
                    struct rg_agreement *agreement)
{
    const struct rg_subject subject = subject_of(cell);
    struct rg_drawn due = {truth_name, {0}};
    const struct rg_drawn drawn = {device->info.name, *picture};
    if (!rg_alike_has_room(cell, agreement))
        return false;
    if (!rg_truth_open(truth) ||
        !rg_frame_draw(truth->device, &subject, cell->frames, &due.picture))
        return rg_agreement_fails(agreement, truth_name);
    const bool holds =
        rg_alike_pictures(cell, truth->device, rg_tier_owed(&device->info, &truth->device->info),
                          &due, &drawn, agreement);
    rg_picture_destroy(&due.picture);
    return holds;
}

bool rg_truth_close(struct rg_truth *truth)
{
    const bool clean = rg_device_close(truth->device);
    truth->device = NULL;
    return clean;
}

// --- times ---

bool rg_lone_are_over(void *user)
{
    const struct rg_lone_times *t = user;
    return rg_interrupted() || (t->end_ms > 0 && rg_now_ms() >= t->end_ms);
}

// A side is opened by the first of its rows, so that one that does not open harms no other.
bool rg_lone_launch(int number, void *user)
{
    struct rg_lone_times *t = user;
    (void)number;
    for (int side = 0; side < t->side_count; side++)
        rg_side_close(&t->sides[side]);
    for (int i = 0; i < RG_YARDSTICKS; i++) {
        struct rg_launches *of = &t->yardsticks[i];
        const double ms = rg_yardstick_take(t->room, (enum rg_yardstick)i);
        if (of->count < RG_BASELINE_LAUNCHES)
            of->ms[of->count++] = ms;
    }
    return true;
}

static bool time_it(struct rg_timed_cell *timed, struct rg_session *session, struct rg_quads *quads)
{
    enum { SLOTS = 3 };
    double warm_ms, slots_ms[SLOTS];
    if (!rg_slot_warm_up(session, &warm_ms))
        return false;
    if (!timed->slot.frames)
        rg_slot_settle(&timed->slot, warm_ms);
    const struct rg_processor_time before = rg_processor_time();
    for (int i = 0; i < SLOTS; i++)
        if (!rg_slot_time(session, &timed->slot, &slots_ms[i]))
            return false;
    const double frame_ms = rg_median(slots_ms, SLOTS).median;
    *quads = (struct rg_quads){
        .log = log(frame_ms), .b_ms = frame_ms, .is_disturbed = rg_was_disturbed(&before)};
    return true;
}

bool rg_lone_take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    struct rg_lone_times *t = user;
    struct rg_timed_cell *timed = &t->cells[row];
    struct rg_side *side = &t->sides[t->side_of[row]];
    const struct rg_subject subject = subject_of(timed->cell);
    const double start_ms = rg_now_ms();
    (void)b_first;
    struct rg_session *session = side->device || rg_side_launch(side)
                                     ? rg_session_run(side->device, &subject, timed->cell->frames)
                                     : NULL;
    const bool ok = session && time_it(timed, session, quads);
    if (!ok)
        rg_timed_cell_fails(timed);
    rg_session_close(session);
    timed->seconds += (rg_now_ms() - start_ms) / 1000;
    return ok && !rg_interrupted();
}
