#include "harness/compare/gate/baseline/baseline.h"

#include <math.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/passport.h"

struct make {
    const struct rg_baseline_request *asked;
    struct rg_baseline *made;
    struct rg_side sides[RG_MAX_DEVICES];
    struct rg_baseline_making *how;
    struct rg_timed_cell *cells; // one per row; rows that are not OK are not timed
};

// --- everything but times ---

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

// A wrong picture must not become the measure of later ones.
static void check(struct rg_truth *truth, const struct rg_gate_cell *cell, struct rg_device *device,
                  const struct rg_picture *picture, struct rg_baseline_row *row)
{
    struct rg_agreement agreement = {.outcome = RG_OK};
    if (row->outcome != RG_OK || rg_truth_holds(truth, cell, device, picture, &agreement))
        return;
    row->outcome = agreement.outcome;
    rg_text_copy(row->why, sizeof(row->why), agreement.message);
}

static bool take_all(struct make *m, const struct rg_devices *devices, struct rg_progress *bar)
{
    struct rg_truth truth = {.device = NULL};
    bool ok = true;
    for (int d = 0; ok && d < devices->count; d++)
        for (int64_t i = 0; ok && i < m->asked->cells->count; i++) {
            const struct rg_gate_cell *cell = &m->asked->cells->cells[i];
            struct rg_baseline_row *row = rg_baseline_add(m->made);
            struct rg_picture picture = {0};
            const double start_ms = rg_now_ms();
            ok = row && !rg_interrupted();
            if (!ok)
                break;
            rg_progress_label(bar, "%s on %s", cell->name, devices->devices[d]->info.name);
            rg_baseline_take(cell, devices->devices[d], row, &picture);
            check(&truth, cell, devices->devices[d], &picture, row);
            rg_picture_destroy(&picture);
            row->seconds = (rg_now_ms() - start_ms) / 1000;
            rg_progress_add(bar, 1);
        }
    m->how->has_failed |= !rg_truth_close(&truth);
    return ok;
}

static bool is_well(const struct make *m, int device)
{
    const int64_t cells = m->asked->cells->count;
    bool well = true;
    for (int64_t i = 0; i < cells; i++)
        well &= m->made->rows[device * cells + i].outcome == RG_OK;
    return well;
}

// A device that failed a cell has been told of, and its fixed functions are left alone.
static bool take_fixed(struct make *m, const struct rg_devices *devices, struct rg_progress *bar)
{
    for (int i = 0; i < devices->count && !rg_interrupted(); i++) {
        struct rg_device *device = devices->devices[i];
        struct rg_fixed_left left;
        if (!is_well(m, i))
            continue;
        rg_progress_label(bar, "fixed functions on %s", device->info.name);
        rg_fixed_draw_all(device, &left);
        m->how->has_failed |= left.failed != RG_OK && left.failed != RG_LACKING;
        m->how->is_lacking |= left.failed == RG_LACKING;
        rg_fixed_put(m->made->passport, device->info.name, left.digests);
        rg_fixed_put_within(m->made->passport, device->info.name, &left);
        rg_fixed_left_free(&left);
    }
    return !rg_interrupted();
}

// --- times ---

static bool plan_times(struct make *m)
{
    const int64_t cells = m->asked->cells->count;
    m->cells = rg_alloc((size_t)m->made->count, sizeof(*m->cells), "baseline");
    for (int64_t i = 0; m->cells && i < m->made->count; i++)
        m->cells[i] = (struct rg_timed_cell){.cell = &m->asked->cells->cells[i % cells],
                                             .sides = {NULL, &m->sides[i / cells]},
                                             .outcome = m->made->rows[i].outcome};
    return m->cells;
}

static bool is_done(const struct make *m, int row)
{
    return m->cells[row].outcome != RG_OK ||
           m->made->rows[row].launches.count == m->asked->launches;
}

static void take_time(struct make *m, struct rg_gate_times *times, int row)
{
    struct rg_launches *launches = &m->made->rows[row].launches;
    struct rg_quads quads;
    if (!is_done(m, row) && rg_times_take(row, false, &quads, times) && !quads.is_disturbed)
        launches->ms[launches->count++] = rg_number_kept(quads.b_ms);
}

// Each launch begins with another row, and every second one runs backwards. Launches that do not
// count are repeated, up to as many again.
static bool time_all(struct make *m, struct rg_gate_times *times, struct rg_progress *bar)
{
    const int count = (int)m->made->count;
    for (int launch = 0; launch < 2 * m->asked->launches && !rg_interrupted(); launch++) {
        int done = 0;
        while (done < count && is_done(m, done))
            done++;
        if (done == count)
            break;
        rg_progress_label(bar, "launch %d", launch + 1);
        rg_times_launch(launch, times);
        for (int i = 0; i < count && !rg_interrupted(); i++) {
            const int at = (i + launch / 2) % count;
            take_time(m, times, launch & 1 ? count - 1 - at : at);
        }
        rg_progress_add(bar, count);
    }
    for (int i = 0; i < count; i++) {
        struct rg_baseline_row *row = &m->made->rows[i];
        row->slot = m->cells[i].slot;
        row->seconds += m->cells[i].seconds;
        if (row->outcome == m->cells[i].outcome)
            continue;
        row->outcome = m->cells[i].outcome;
        row->launches.count = 0; // some launches alone make no baseline
        rg_text_copy(row->why, sizeof(row->why), m->cells[i].why);
    }
    return !rg_interrupted();
}

static bool take_times(struct make *m, struct rg_progress *bar)
{
    struct rg_yardstick_room room = {NULL};
    struct rg_gate_times times = {.side_count = m->made->device_count,
                                  .sides = m->sides,
                                  .room = &room,
                                  .yardsticks = m->made->yardsticks};
    for (int i = 0; i < m->made->device_count; i++)
        m->sides[i].name = m->made->devices[i].name;
    bool ok = rg_yardsticks_open(&room) && plan_times(m);
    times.cells = m->cells;
    ok = ok && time_all(m, &times, bar);
    for (int i = 0; i < m->made->device_count; i++) {
        rg_side_close(&m->sides[i]);
        m->how->has_failed |= m->sides[i].was_closed_badly;
    }
    rg_yardsticks_close(&room);
    return ok;
}

bool rg_baseline_make(const struct rg_baseline_request *request, struct rg_devices *devices,
                      struct rg_baseline *baseline, struct rg_baseline_making *making)
{
    struct make m = {.asked = request, .made = baseline, .how = making};
    struct rg_progress bar;
    const int64_t rows = request->cells->count * devices->count;
    *making = (struct rg_baseline_making){0};
    rg_interrupt_watch();
    rg_progress_start(&bar, rows * (1 + request->launches));
    bool ok = set_devices(baseline, devices) && take_all(&m, devices, &bar) &&
              take_fixed(&m, devices, &bar);
    making->has_failed |= !rg_devices_close(devices);
    ok = ok && (!request->launches || take_times(&m, &bar));
    rg_progress_end(&bar);
    free(m.cells);
    return ok && !rg_interrupted();
}
