// How long the cells of a plan are expected to take.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "harness/tables/farm/make.h"
#include "harness/tables/measuring/cell.h"
#include "harness/tables/measuring/measure.h"

// A cell without any record near it: so many calibration loads for its opening and for a frame, as
// the records of results/tables say of the slower devices.
#define OPEN_LOADS  300
#define FRAME_LOADS 200
// What did not run takes the time in which that is found out.
#define LEAST_S 0.05

struct mean {
    double sum;
    int64_t count;
};

struct expecting {
    struct rg_farm_plan *plan;
    const struct rg_table *const *tables;
    int count;
    const struct rg_stored *stored;
    struct mean *means; // of each table's known cells on each device, then on all; and of all
};

static void add(struct mean *mean, double value)
{
    mean->sum += value;
    mean->count++;
}

static struct mean *mean_of(const struct expecting *e, int table, int device)
{
    return &e->means[table * (e->plan->device_count + 1) + device];
}

// --- known cells ---

static const struct rg_record *find_in(const struct rg_result *result,
                                       const struct rg_farm_cell *cell, const char *device)
{
    struct rg_place at = rg_result_start_row(cell->row - 1);
    while (rg_result_has(result, cell->row - 1) && rg_result_next_in_row(result, &at)) {
        const struct rg_record *record = rg_result_at(result, at);
        if (!strcmp(record->work, cell->work) && !strcmp(record->variant, cell->variant) &&
            !strcmp(record->device.name, device))
            return record;
    }
    return NULL;
}

// The record of a cell on a device: of the plan's length, or else of the other. NULL: none.
static const struct rg_record *find(const struct expecting *e, const char *table,
                                    const struct rg_farm_cell *cell, const char *device)
{
    const struct rg_record *found = NULL, *other = NULL;
    for (int i = 0; i < e->stored->count && !found; i++) {
        const struct rg_result *result = &e->stored->results[i];
        if (strcmp(result->table, table) != 0)
            continue;
        const struct rg_record *record = find_in(result, cell, device);
        found = result->full == e->plan->full ? record : NULL;
        other = other ? other : record;
    }
    return found ? found : other;
}

static struct rg_cell_frames frames_of(const struct rg_record *record)
{
    const double ms = record->frame_ms.median;
    if (record->outcome != RG_OK || !record->sample_count)
        return (struct rg_cell_frames){0};
    return (struct rg_cell_frames){.open_ms =
                                       record->create_ms + fmax(record->first_frame_ms - ms, 0),
                                   .step_ms = ms,
                                   .frame_ms = ms};
}

// The images that a row's cells are checked by: cpu:reference's, unless it is timed itself, and
// those without rain and without approximations on cpu.
static double images_ms(const struct expecting *e, const struct rg_table *table,
                        const struct rg_farm_cell *cell)
{
    bool has_reference = false;
    for (int d = 0; d < e->plan->device_count; d++)
        has_reference = has_reference || !strcmp(e->plan->devices[d].name, "cpu:reference");
    const struct rg_record *reference = find(e, table->id, cell, "cpu:reference");
    const struct rg_record *cpu = find(e, table->id, cell, "cpu");
    double ms = 0;
    if (reference && !has_reference) {
        const struct rg_cell_frames frames = frames_of(reference);
        ms += rg_cell_image_ms(table, &frames);
    }
    if (cpu) {
        const struct rg_cell_frames frames = frames_of(cpu);
        ms += (table->truth ? 2 : 1) * rg_cell_image_ms(table, &frames);
    }
    return ms;
}

static double seconds_of(const struct expecting *e, const struct rg_table *table,
                         const struct rg_farm_cell *cell, const struct rg_cell_frames *frames)
{
    double ms = table->is_of_textures || !(frames->frame_ms > 0)
                    ? frames->open_ms
                    : rg_cell_ms(table, frames, rg_table_options(e->plan->full));
    if (!table->is_of_textures)
        ms += images_ms(e, table, cell) / e->plan->device_count;
    return fmax(ms / 1000, LEAST_S);
}

static void expect_known(struct expecting *e, int t, struct rg_farm_cell *cell)
{
    const struct rg_record *record =
        find(e, e->tables[t]->id, cell, e->plan->devices[cell->device].name);
    if (!record)
        return;
    const struct rg_cell_frames frames = frames_of(record);
    cell->seconds = seconds_of(e, e->tables[t], cell, &frames);
    cell->is_known = true;
    add(mean_of(e, t, cell->device), cell->seconds);
    add(mean_of(e, t, e->plan->device_count), cell->seconds);
    add(mean_of(e, e->count, cell->device), cell->seconds);
    add(mean_of(e, e->count, e->plan->device_count), cell->seconds);
}

// --- the others ---

static void expect_unknown(const struct expecting *e, int t, struct rg_farm_cell *cell,
                           double load_ms)
{
    const int all = e->plan->device_count;
    const struct mean *const near[] = {mean_of(e, t, cell->device), mean_of(e, t, all),
                                       mean_of(e, e->count, cell->device),
                                       mean_of(e, e->count, all)};
    const struct rg_cell_frames frames = {OPEN_LOADS * load_ms, FRAME_LOADS * load_ms,
                                          FRAME_LOADS * load_ms};
    for (int i = 0; i < 4; i++)
        if (near[i]->count) {
            cell->seconds = near[i]->sum / (double)near[i]->count;
            return;
        }
    cell->seconds = seconds_of(e, e->tables[t], cell, &frames);
}

// --- a plan ---

static int table_of(const struct expecting *e, const struct rg_farm_group *group, int near)
{
    for (int i = 0; i < e->count; i++) {
        const int t = (near + i) % e->count;
        if (!strcmp(e->tables[t]->id, group->table))
            return t;
    }
    return near;
}

int64_t rg_farm_expect(struct rg_farm_plan *plan, const struct rg_table *const tables[], int count,
                       const struct rg_stored *stored, double load_ms)
{
    struct expecting e = {plan, tables, count, stored, NULL};
    int64_t known = 0;
    e.means = rg_alloc((size_t)(count + 1) * (size_t)(plan->device_count + 1), sizeof(*e.means),
                       "expected times");
    if (!e.means)
        return -1;
    for (int pass = 0; pass < 2; pass++)
        for (int64_t g = 0, t = 0; g < plan->group_count; g++) {
            const struct rg_farm_group *group = &plan->groups[g];
            t = table_of(&e, group, (int)t);
            for (int i = 0; i < group->cell_count; i++) {
                struct rg_farm_cell *cell = &plan->cells[group->first_cell + i];
                if (!pass)
                    expect_known(&e, (int)t, cell);
                else if (!cell->is_known)
                    expect_unknown(&e, (int)t, cell, load_ms);
                known += pass && cell->is_known;
            }
        }
    free(e.means);
    rg_farm_sum(plan);
    return known;
}
