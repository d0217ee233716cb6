#include "harness/tables/runs/look.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/runs/needed.h"
#include "harness/tables/table.h"

// --- a table ---

// The first and the last of the rows that curves and claims need.
static void choose_ends(const struct rg_table *table, bool rows[RG_TABLE_ROWS])
{
    bool needed[RG_TABLE_ROWS];
    int last = 0;
    rg_needed_rows(table, needed);
    for (int row = 0; row < table->row_count; row++)
        last = needed[row] ? row : last;
    rows[0] = rows[last] = true;
}

void rg_look_begin(struct rg_looking *p, const struct rg_table *table, struct rg_kept *kept,
                   const struct rg_table_part *part, const bool *rows, struct rg_budget_kind *kind)
{
    *p = (struct rg_looking){.table = table, .kept = kept, .kind = kind, .first = -1, .steps = 1};
    if (rows)
        memcpy(p->rows, rows, sizeof(p->rows));
    else
        choose_ends(table, p->rows);
    for (int row = 0; row < table->row_count; row++) {
        p->first = p->rows[row] && p->first < 0 ? row : p->first;
        p->last = p->rows[row] ? row : p->last;
    }
    rg_table_begin(&p->result, table, part, kept->devices);
}

enum rg_budget_size rg_look_smallest(const struct rg_table *table)
{
    enum { SMALL_PIXELS = 512 * 512 };
    const bool is_small = rg_needs_size(table) || table->width * table->height <= SMALL_PIXELS;
    return is_small ? RG_BUDGET_WHOLE : RG_BUDGET_FOURTH;
}

// --- what is opened ---

// What is shared by the instances of a device is made when the first is opened, and lives as long
// as one is kept.
static bool probe_subject(struct rg_kept *kept, struct rg_device *device,
                          const struct rg_subject *subject, int steps,
                          struct rg_cell_frames *frames)
{
    struct rg_session *session = device ? rg_cell_look(device, subject, steps, frames) : NULL;
    if (session)
        rg_kept_put(kept, session);
    return session;
}

static const int divisors[] = {4, 2, 1};

void *rg_look_settings(const struct rg_looking *p, int row, enum rg_budget_size size,
                       const char *over)
{
    const struct rg_technique *technique = rg_technique_find(p->table->technique);
    struct rg_table table = *p->table;
    char *quick = rg_table_quick(&table, divisors[size]), *assignments = NULL;
    void *defaults = rg_settings_create(technique), *of_row = NULL, *settings = NULL;
    table.quick = quick;
    if (quick)
        assignments = rg_table_assignments(&p->result, &table,
                                           (struct rg_place){.row = row, .work = p->work});
    if (defaults && assignments)
        of_row = rg_settings_copy(technique, defaults, assignments);
    if (of_row)
        settings = rg_settings_copy(technique, of_row, over);
    free(of_row);
    free(defaults);
    free(assignments);
    free(quick);
    return settings;
}

bool rg_look_row(struct rg_looking *p, struct rg_device *device, int row, enum rg_budget_size size,
                 const char *over, struct rg_cell_frames *frames)
{
    void *settings = rg_look_settings(p, row, size, over);
    const struct rg_subject subject = {rg_technique_find(p->table->technique), settings,
                                       p->table->width / divisors[size],
                                       p->table->height / divisors[size]};
    const bool ok = settings && probe_subject(p->kept, device, &subject, p->steps, frames);
    free(settings);
    return ok;
}

void rg_look_extend(struct rg_frames *frames, enum rg_budget_size smallest, const double larger[])
{
    const double small_ms = frames->frame_ms[smallest];
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        frames->frame_ms[size] = small_ms * larger[size];
}

// On a new machine drivers compile in a first opening, its first step and its first frames, and
// keep what they made: where that one was late, a second one tells what those of cells will take.
static bool look_compiled(struct rg_looking *p, struct rg_device *device,
                          struct rg_cell_frames *frames)
{
    return rg_look_row(p, device, p->last, p->smallest, "", frames) &&
           (frames->open_ms < RG_LOOK_LATE_MS ||
            rg_look_row(p, device, p->last, p->smallest, "", frames));
}

bool rg_look_device(struct rg_looking *p, struct rg_device *device, struct rg_frames *frames)
{
    static const double pixels[] = {1 / 16.0, 1 / 4.0, 1};
    const enum rg_budget_size smallest = p->smallest;
    struct rg_cell_frames small, next;
    double a_pixel = 0, larger[RG_BUDGET_SIZES];
    if (!look_compiled(p, device, &small))
        return false;
    *frames = (struct rg_frames){.open_ms = small.open_ms, .step_ms = small.step_ms};
    if (smallest < RG_BUDGET_WHOLE) {
        if (!rg_look_row(p, device, p->last, smallest + 1, "", &next))
            return false;
        a_pixel =
            fmax(next.frame_ms - small.frame_ms, 0) / (pixels[smallest + 1] - pixels[smallest]);
        frames->open_ms = fmin(small.open_ms, next.open_ms);
    }
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        larger[size] =
            1 + a_pixel / fmax(small.frame_ms, 1e-3) * fmax(pixels[size] - pixels[smallest], 0);
    frames->frame_ms[smallest] = small.frame_ms;
    rg_look_extend(frames, smallest, larger);
    return true;
}

bool rg_look_settled(struct rg_looking *p, int row)
{
    const struct rg_frames *first = &p->of_row[row];
    const int steps = rg_cell_steps(p->table);
    struct rg_frames *settled = &p->settled[row];
    struct rg_cell_frames f;
    *settled = *first;
    if (steps == 1 && row != p->last)
        return true;
    p->steps = steps;
    const bool ok = rg_look_row(p, p->cpu, row, p->smallest, "", &f);
    p->steps = 1;
    if (!ok)
        return false;
    settled->open_ms = f.open_ms;
    settled->step_ms = f.step_ms;
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        settled->frame_ms[size] =
            first->frame_ms[size] * f.frame_ms / fmax(first->frame_ms[p->smallest], 1e-3);
    return true;
}

// --- what a technique takes on other devices, by what it takes on cpu ---

// The place of a device among those of a kind; cpu:reference, which checks, has the last.
static struct rg_frames *of_kind(struct rg_budget_kind *kind, const struct rg_device *device,
                                 const struct rg_kept *kept)
{
    for (int d = 0; d < kept->devices->count; d++)
        if (kept->devices->devices[d] == device)
            return &kind->by_cpu[d];
    return &kind->by_cpu[RG_MAX_DEVICES];
}

static struct rg_frames ratio_of(const struct rg_frames *a, const struct rg_frames *b)
{
    struct rg_frames ratio = {.open_ms = a->open_ms / fmax(b->open_ms, 0.1),
                              .step_ms = a->step_ms / fmax(b->step_ms, 1e-3)};
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        ratio.frame_ms[size] = a->frame_ms[size] / fmax(b->frame_ms[size], 1e-3);
    return ratio;
}

struct rg_frames rg_look_scaled(const struct rg_frames *cpu, const struct rg_frames *ratio)
{
    struct rg_frames frames = {.open_ms = cpu->open_ms * ratio->open_ms,
                               .step_ms = cpu->step_ms * ratio->step_ms};
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        frames.frame_ms[size] = cpu->frame_ms[size] * ratio->frame_ms[size];
    return frames;
}

bool rg_look_ratio(struct rg_looking *p, struct rg_device *device, struct rg_frames *ratio)
{
    *ratio = (struct rg_frames){1, 1, {1, 1, 1}};
    if (device == p->cpu)
        return true;
    struct rg_frames *known = of_kind(p->kind, device, p->kept), found;
    if (!(known->frame_ms[RG_BUDGET_WHOLE] > 0)) {
        if (!device || !rg_look_device(p, device, &found))
            return false;
        *known = ratio_of(&found, &p->of_row[p->last]);
    }
    *ratio = *known;
    return true;
}

// --- other works ---

static const char *set_of(const struct rg_looking *p, int work)
{
    return rg_table_work_at(&p->result, p->table, (struct rg_place){.work = work})->set;
}

static struct rg_work_frames *find_work(struct rg_budget_kind *kind, const char *set,
                                        const char *first_set)
{
    for (int i = 0; i < kind->work_count; i++)
        if (!strcmp(kind->works[i].set, set) && !strcmp(kind->works[i].first_set, first_set))
            return &kind->works[i];
    return NULL;
}

// What is known of a work is forgotten where there are more than there is room for.
static struct rg_work_frames *add_work(struct rg_budget_kind *kind, const char *set,
                                       const char *first_set)
{
    const int last = RG_RESULT_WORKS - 1;
    struct rg_work_frames *work = &kind->works[kind->work_count < last ? kind->work_count : last];
    kind->work_count += kind->work_count < RG_RESULT_WORKS;
    *work = (struct rg_work_frames){.set = set, .first_set = first_set};
    return work;
}

const struct rg_work_frames *rg_look_work(struct rg_looking *p, int work,
                                          const struct rg_frames of[RG_MAX_DEVICES],
                                          const bool is_there[RG_MAX_DEVICES])
{
    const char *set = set_of(p, work), *first_set = set_of(p, 0);
    struct rg_work_frames *found = find_work(p->kind, set, first_set);
    if (found)
        return found;
    found = add_work(p->kind, set, first_set);
    p->work = work;
    for (int d = 0; d < p->kept->devices->count; d++) {
        struct rg_cell_frames f;
        if (!is_there[d] ||
            !rg_look_row(p, p->kept->devices->devices[d], p->last, p->smallest, "", &f))
            continue;
        const struct rg_frames first = rg_look_scaled(&p->of_row[p->last], &of[d]);
        struct rg_frames own = {.open_ms = f.open_ms, .step_ms = f.step_ms};
        for (int size = 0; size < RG_BUDGET_SIZES; size++)
            own.frame_ms[size] = f.frame_ms;
        found->by_first[d] = ratio_of(&own, &first);
        found->is_there[d] = true;
    }
    p->work = 0;
    return found;
}
