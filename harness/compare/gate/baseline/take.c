#include "harness/compare/gate/baseline/baseline.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "harness/devices/frames/frame.h"

// --- everything but times ---

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

// Takes the counters, and the work of one further frame.
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
    snprintf(row->cell, sizeof(row->cell), "%s", cell->name);
    snprintf(row->technique, sizeof(row->technique), "%s", cell->subject.technique->name);
    snprintf(row->device, sizeof(row->device), "%s", device->info.name);
    rg_digest_of_cell(cell, row->settings);
    *picture = (struct rg_picture){0};
    struct rg_session *session = rg_session_run(device, &cell->subject, cell->frames);
    if (!session || !take_picture(session, row, picture) || !take_states(session, row) ||
        !take_work(session, row) || !rg_session_code(session, &row->code)) {
        row->outcome = rg_side_failure(&row->is_ours, row->why, sizeof(row->why));
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
                    struct rg_device *device, const struct rg_picture *picture,
                    struct rg_agreement *agreement)
{
    struct rg_drawn due = {truth_name, NULL, {0}};
    const struct rg_drawn drawn = {device->info.name, device, *picture};
    if (!rg_alike_has_room(cell, agreement))
        return false;
    if (!rg_truth_open(truth) ||
        !rg_frame_draw(truth->device, &cell->subject, cell->frames, &due.picture))
        return rg_agreement_fails(agreement, truth_name);
    due.device = truth->device;
    const bool holds = rg_alike_pictures(cell, &due, &drawn, agreement);
    rg_picture_destroy(&due.picture);
    return holds;
}

bool rg_truth_close(struct rg_truth *truth)
{
    const bool clean = rg_device_close(truth->device);
    truth->device = NULL;
    return clean;
}
