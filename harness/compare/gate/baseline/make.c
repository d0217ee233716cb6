#include "harness/compare/gate/baseline/make.h"

#include <math.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/gate/baseline/take.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/passport.h"

struct make {
    const struct rg_baseline_request *asked;
    struct rg_baseline *made;
    struct rg_side sides[RG_MAX_DEVICES];
    bool clean;                  // no device was closed badly
    struct rg_timed_cell *cells; // of those rows that are timed
    int *side_of;
    struct rg_baseline_row **rows; // likewise
    int timed_count;
};

// --- what is the same every time ---

static bool set_devices(struct rg_baseline *made, const struct rg_devices *devices)
{
    struct rg_device_info infos[RG_MAX_DEVICES];
    for (int i = 0; i < devices->count; i++)
        infos[i] = devices->devices[i]->info;
    made->passport = rg_passport_json(infos, devices->count);
    for (int i = 0; i < devices->count; i++) {
        struct rg_baseline_device *device = &made->devices[made->device_count++];
        json_t *json = rg_passport_device(&infos[i]);
        rg_text_copy(device->name, sizeof(device->name), infos[i].name);
        device->parts = rg_key_parts(made->passport, json);
        json_decref(json);
    }
    return made->passport != NULL;
}

// A picture that is not what it should be is no measure of later ones.
static void check(struct rg_truth *truth, const struct rg_gate_cell *cell,
                  const struct rg_device *device, const struct rg_picture *picture,
                  struct rg_baseline_row *row)
{
    struct rg_agreement agreement = {.outcome = RG_OK};
    if (row->outcome != RG_OK || rg_truth_holds(truth, cell, device, picture, &agreement))
        return;
    row->outcome = agreement.outcome;
    rg_text_copy(row->why, sizeof(row->why), agreement.message);
}

static bool take_all(struct make *m, const struct rg_devices *devices, struct rg_progress *bar)
{
    struct rg_truth truth = {NULL};
    bool ok = true;
    for (int d = 0; ok && d < devices->count; d++)
        for (int64_t i = 0; ok && i < m->asked->cells->count; i++) {
            const struct rg_gate_cell *cell = &m->asked->cells->cells[i];
            struct rg_baseline_row *row = rg_baseline_add(m->made);
            struct rg_picture picture = {0};
            ok = row && !rg_interrupted();
            if (!ok)
                break;
            rg_progress_label(bar, "%s on %s", cell->name, devices->devices[d]->info.name);
            rg_baseline_take(cell, devices->devices[d], row, &picture);
            check(&truth, cell, devices->devices[d], &picture, row);
            rg_picture_destroy(&picture);
            rg_progress_add(bar, 1);
        }
    m->clean = rg_truth_close(&truth) && m->clean;
    return ok;
}

// --- times ---

static bool plan_times(struct make *m)
{
    const size_t count = (size_t)m->made->count;
    m->cells = rg_alloc(count, sizeof(*m->cells), "baseline");
    m->side_of = rg_alloc(count, sizeof(*m->side_of), "baseline");
    m->rows = rg_alloc(count, sizeof(struct rg_baseline_row *), "baseline");
    if (!m->cells || !m->side_of || !m->rows)
        return false;
    for (size_t i = 0; i < count; i++) {
        const size_t cells = (size_t)m->asked->cells->count;
        if (m->made->rows[i].outcome != RG_OK)
            continue;
        m->cells[m->timed_count] =
            (struct rg_timed_cell){.cell = &m->asked->cells->cells[i % cells]};
        m->side_of[m->timed_count] = (int)(i / cells);
        m->rows[m->timed_count++] = &m->made->rows[i];
    }
    return true;
}

static void take_time(struct make *m, struct rg_lone_times *times, int number)
{
    struct rg_launches *launches = &m->rows[number]->launches;
    struct rg_timed_cell *cell = &m->cells[number];
    struct rg_quads quads;
    if (launches->count == m->asked->launches || cell->outcome != RG_OK ||
        !rg_lone_take(number, false, &quads, times) || quads.is_disturbed)
        return;
    launches->ms[launches->count++] = rg_number_kept(quads.b_ms);
}

// Every launch begins with another row, and every second goes the other way. For launches that do
// not count there are others, as many again.
static bool time_all(struct make *m, struct rg_lone_times *times, struct rg_progress *bar)
{
    for (int launch = 0; launch < 2 * m->asked->launches && !rg_interrupted(); launch++) {
        bool is_done = true;
        for (int i = 0; i < m->timed_count; i++)
            is_done &=
                m->cells[i].outcome != RG_OK || m->rows[i]->launches.count == m->asked->launches;
        if (is_done)
            break;
        rg_progress_label(bar, "launch %d", launch + 1);
        rg_lone_launch(launch, times);
        for (int i = 0; i < m->timed_count && !rg_interrupted(); i++) {
            const int at = (i + launch / 2) % m->timed_count;
            take_time(m, times, launch & 1 ? m->timed_count - 1 - at : at);
        }
        rg_progress_add(bar, m->timed_count);
    }
    for (int i = 0; i < m->timed_count; i++) {
        m->rows[i]->slot = m->cells[i].slot;
        m->rows[i]->outcome = m->cells[i].outcome;
        if (m->cells[i].outcome == RG_OK)
            continue;
        m->rows[i]->launches.count = 0; // a part of them is no time
        rg_text_copy(m->rows[i]->why, sizeof(m->rows[i]->why), m->cells[i].why);
    }
    return !rg_interrupted();
}

static bool take_times(struct make *m, struct rg_progress *bar)
{
    struct rg_yardstick_room room = {NULL};
    struct rg_lone_times times = {.side_count = m->made->device_count,
                                  .sides = m->sides,
                                  .room = &room,
                                  .yardsticks = m->made->yardsticks};
    for (int i = 0; i < m->made->device_count; i++)
        m->sides[i].name = m->made->devices[i].name;
    bool ok = rg_yardsticks_open(&room) && plan_times(m);
    times.cells = m->cells;
    times.side_of = m->side_of;
    ok = ok && time_all(m, &times, bar);
    for (int i = 0; i < m->made->device_count; i++) {
        rg_side_close(&m->sides[i]);
        m->clean = m->clean && !m->sides[i].was_closed_badly;
    }
    rg_yardsticks_close(&room);
    return ok;
}

bool rg_baseline_make(const struct rg_baseline_request *request, struct rg_devices *devices,
                      struct rg_baseline *baseline, bool *clean)
{
    struct make m = {.asked = request, .made = baseline, .clean = true};
    struct rg_progress bar;
    const int64_t rows = request->cells->count * devices->count;
    rg_interrupt_watch();
    rg_progress_start(&bar, rows * (1 + request->launches));
    bool ok = set_devices(baseline, devices) && take_all(&m, devices, &bar);
    m.clean = rg_devices_close(devices) && m.clean;
    ok = ok && (!request->launches || take_times(&m, &bar));
    rg_progress_end(&bar);
    free(m.rows);
    free(m.side_of);
    free(m.cells);
    *clean = m.clean;
    return ok && !rg_interrupted();
}
