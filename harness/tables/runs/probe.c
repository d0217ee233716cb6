#include "harness/tables/runs/probe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/measure/sampling.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/runs/look.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/textures.h"

static void name_costs(const struct rg_table *table, struct rg_budget_table *costs)
{
    bool needed[RG_TABLE_ROWS], rows[RG_TABLE_ROWS], variants[RG_TABLE_VARIANTS];
    *costs = (struct rg_budget_table){.rows = rg_quick_rows(table, rows),
                                      .needed_rows = rg_needed_rows(table, needed),
                                      .needed_variants = rg_needed_variants(table, variants),
                                      .has_claims = rg_has_claims(table),
                                      .smallest = rg_look_smallest(table)};
    while (costs->variants < RG_TABLE_VARIANTS && table->variants[costs->variants].name)
        costs->variants++;
    while (costs->works < RG_TABLE_WORKS && table->works[costs->works].name)
        costs->works++;
    costs->works += !costs->works;
}

// A row on cpu. How a larger picture takes longer is known once a row of the technique was looked
// at.
static bool probe_row(struct rg_looking *p, int row)
{
    struct rg_cell_frames small;
    if (!p->kind->is_known)
        return rg_look_device(p, p->cpu, &p->of_row[row]);
    if (!rg_look_row(p, p->cpu, row, p->smallest, "", &small))
        return false;
    p->of_row[row] = (struct rg_frames){.open_ms = small.open_ms, .step_ms = small.step_ms};
    p->of_row[row].frame_ms[p->smallest] = small.frame_ms;
    rg_look_extend(&p->of_row[row], p->smallest, p->kind->larger);
    return true;
}

// What holds of all tables of a technique: how a larger picture takes longer, and one without rain
// less.
static bool learn(struct rg_looking *p)
{
    struct rg_budget_kind *kind = p->kind;
    const double small_ms = fmax(p->of_row[p->last].frame_ms[p->smallest], 1e-3);
    const char *without = rg_technique_find(p->table->technique)->proof->dry;
    struct rg_cell_frames dry;
    if (kind->is_known)
        return true;
    if (!rg_look_row(p, p->cpu, p->last, p->smallest, without, &dry))
        return false;
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        kind->larger[size] = p->of_row[p->last].frame_ms[size] / small_ms;
    kind->dry_share = dry.frame_ms / small_ms;
    return kind->is_known = true;
}

// Whether other rows can be opened where one could not, as one whose model is absent: what a driver
// fails in would fail them too, each after as long a wait.
static bool others_may(void)
{
    const enum rg_fault fault = rg_failure_take().fault;
    return (fault == RG_FAULT_INPUT || fault == RG_FAULT_NONE) && !rg_interrupted();
}

// The last row that can be opened stands for the table. False where there is none.
static bool probe_last(struct rg_looking *p)
{
    while (!probe_row(p, p->last)) {
        p->rows[p->last] = false;
        while (p->last >= p->first && !p->rows[p->last])
            p->last--;
        if (p->last < p->first || !others_may())
            return false;
    }
    return true;
}

// Rows before it; those that cannot be opened are not looked at.
static bool probe_others(struct rg_looking *p)
{
    for (int row = p->first; row < p->last; row++) {
        if (!p->rows[row] || probe_row(p, row))
            continue;
        p->rows[row] = false;
        if (!others_may())
            return false;
    }
    while (!p->rows[p->first])
        p->first++;
    return true;
}

static bool probe_cpu(struct rg_looking *p)
{
    p->cpu = rg_kept_device(p->kept, "cpu");
    bool ok = p->cpu && probe_last(p) && learn(p) && probe_others(p);
    for (int row = p->first; ok && row <= p->last; row++)
        ok = !p->rows[row] || rg_look_settled(p, row);
    return ok;
}

static struct rg_cell_frames at_size(const struct rg_frames *f, int size)
{
    return (struct rg_cell_frames){f->open_ms, f->step_ms, f->frame_ms[size]};
}

// A row's picture with all that it shows, where the smallest has less, and the truth, which take as
// long at all sizes: rain out of sight takes the most of it. Known once a table of the technique
// was looked at.
static bool learn_truth(struct rg_looking *p)
{
    const struct rg_table *table = p->table;
    struct rg_budget_kind *kind = p->kind;
    char over[2 * RG_TITLE_SIZE];
    if (!table->truth || kind->has_truth)
        return true;
    snprintf(over, sizeof(over), "%s %s", table->shown ? table->shown : "", table->truth);
    const bool is_shown = !table->shown || p->smallest == RG_BUDGET_WHOLE;
    return kind->has_truth = (is_shown || rg_look_row(p, p->cpu, p->first, p->smallest,
                                                      table->shown, &kind->shown)) &&
                             rg_look_row(p, p->cpu, p->first, p->smallest, over, &kind->truth);
}

// What the error of a row's picture takes.
static double error_ms(const struct rg_looking *p, int size, double a_pixel_ms)
{
    const struct rg_table *table = p->table;
    if (!rg_budget_has_truth(table, size))
        return 0;
    return rg_cell_image_ms(table, &p->kind->shown) + rg_cell_image_ms(table, &p->kind->truth) +
           a_pixel_ms * table->width * table->height / (1 << 2 * (2 - size));
}

// The picture that a row's cells must show, which cpu:reference draws; the same without rain, and
// the truth that it is compared with, which cpu does.
static double check_ms(const struct rg_looking *p, int row, int size,
                       const struct rg_frames *reference, double a_pixel_ms)
{
    const struct rg_frames of_reference = rg_look_scaled(&p->settled[row], reference);
    const struct rg_cell_frames expected = at_size(&of_reference, size);
    struct rg_cell_frames dry = at_size(&p->settled[row], size);
    dry.frame_ms *= p->kind->dry_share;
    return rg_cell_image_ms(p->table, &expected) + rg_cell_image_ms(p->table, &dry) +
           error_ms(p, size, a_pixel_ms);
}

static struct rg_budget_cost cost_of(const struct rg_looking *p, const struct rg_cell_frames *f)
{
    const struct rg_measure_options *all = rg_table_options(p->result.full);
    const struct rg_sampling sampling =
        rg_sampling_of(fmax(f->frame_ms, 1e-3), p->table->window_frames, all);
    return (struct rg_budget_cost){1e-3 * rg_cell_ms(p->table, f, rg_table_few_samples()),
                                   1e-3 * rg_cell_ms(p->table, f, all),
                                   1e-3 * rg_sampling_ms(&sampling, f->frame_ms)};
}

// What is known of a table's devices, once its rows were looked at.
struct known {
    struct rg_frames reference, of[RG_MAX_DEVICES];
    bool works[RG_MAX_DEVICES]; // what cannot be opened takes nothing
    double a_pixel_ms;
    // Works beside the first that are looked at.
    struct rg_work_frames others[RG_RESULT_WORKS];
    int other_count;
};

static bool learn_devices(struct rg_looking *p, struct known *known)
{
    *known = (struct known){.a_pixel_ms = p->table->truth ? rg_cell_compare_ms() : 0};
    if (!rg_look_ratio(p, rg_kept_device(p->kept, "cpu:reference"), &known->reference) ||
        !learn_truth(p))
        return false;
    for (int d = 0; d < p->kept->devices->count; d++)
        known->works[d] = rg_look_ratio(p, p->kept->devices->devices[d], &known->of[d]);
    return true;
}

// A frame of another work can take a hundred times as long, as where each drop asks the device a
// question.
static void learn_works(struct rg_looking *p, struct known *known)
{
    while (known->other_count + 1 < p->result.work_count) {
        const int work = known->other_count + 1;
        known->others[known->other_count++] = *rg_look_work(p, work, known->of, known->works);
    }
}

static void add_cost(struct rg_budget_cost *sum, struct rg_budget_cost cost, int works)
{
    sum->few_s += cost.few_s / works;
    sum->all_s += cost.all_s / works;
    sum->sampling_s += cost.sampling_s / works;
}

// What cells of a row take on a device, on average over the works that are looked at.
static void add_device(const struct rg_looking *p, int row, const struct known *known, int device,
                       enum rg_budget_size size, struct rg_budget_cost *sum)
{
    const struct rg_frames first = rg_look_scaled(&p->settled[row], &known->of[device]);
    for (int work = 0; work <= known->other_count; work++) {
        const struct rg_work_frames *other = work ? &known->others[work - 1] : NULL;
        const struct rg_frames frames =
            other ? rg_look_scaled(&first, &other->by_first[device]) : first;
        const struct rg_cell_frames f = at_size(&frames, size);
        if (other ? other->is_there[device] : known->works[device])
            add_cost(sum, cost_of(p, &f), known->other_count + 1);
    }
}

// What cells of a row take, at each size and on each device.
static void add_row(const struct rg_looking *p, int row, const struct known *known,
                    struct rg_budget_table *costs)
{
    for (int size = 0; size < RG_BUDGET_SIZES; size++) {
        costs->check_s[size] += 1e-3 * check_ms(p, row, size, &known->reference, known->a_pixel_ms);
        for (int d = 0; d < p->kept->devices->count; d++)
            add_device(p, row, known, d, size, &costs->cells[d][size]);
    }
}

// Costs are those of the row in the middle, by what it takes: the mean of all that were looked at.
static void divide(struct rg_budget_table *costs, int rows)
{
    for (int size = 0; size < RG_BUDGET_SIZES; size++) {
        costs->check_s[size] /= rows;
        for (int d = 0; d < RG_MAX_DEVICES; d++) {
            costs->cells[d][size].few_s /= rows;
            costs->cells[d][size].all_s /= rows;
            costs->cells[d][size].sampling_s /= rows;
        }
    }
}

bool rg_budget_probe(const struct rg_table *table, struct rg_kept *kept, bool full,
                     struct rg_budget_kind *kind, struct rg_budget_table *costs)
{
    const struct rg_table_part all = {.last_row = table->row_count - 1, .full = full};
    struct rg_looking p;
    struct known known;
    int rows = 0;
    name_costs(table, costs);
    rg_look_begin(&p, table, kept, &all, NULL, kind);
    p.smallest = full ? RG_BUDGET_WHOLE : costs->smallest;
    const bool ok = table->is_of_textures || (probe_cpu(&p) && learn_devices(&p, &known));
    if (table->is_of_textures)
        rg_look_textures(&p, costs);
    for (int row = 0; ok && !table->is_of_textures && row < table->row_count; row++) {
        if (!p.rows[row])
            continue;
        add_row(&p, row, &known, costs);
        rows++;
    }
    if (rows)
        divide(costs, rows);
    rg_result_free(&p.result);
    return ok;
}

// On average over the devices.
static struct rg_cell_time time_of(const struct rg_budget_table *costs,
                                   const struct rg_devices *devices)
{
    struct rg_cell_time time = {.open_ms = 1e3 * costs->check_s[RG_BUDGET_WHOLE]};
    for (int d = 0; d < devices->count; d++) {
        const struct rg_budget_cost *cost = &costs->cells[d][RG_BUDGET_WHOLE];
        time.open_ms += 1e3 * (cost->all_s - cost->sampling_s);
        time.sampling_ms += 1e3 * cost->sampling_s;
        if (!strcmp(devices->devices[d]->info.name, "cpu:reference"))
            time.reference_ms = 1e3 * cost->all_s;
    }
    time.open_ms /= devices->count;
    time.sampling_ms /= devices->count;
    return time;
}

bool rg_budget_probe_rows(const struct rg_table *table, struct rg_kept *kept,
                          const struct rg_table_part *part, const bool rows[RG_TABLE_ROWS],
                          struct rg_budget_kind *kind, struct rg_cell_time times[RG_TABLE_ROWS])
{
    struct rg_looking p;
    struct known known;
    struct rg_budget_table costs;
    name_costs(table, &costs);
    rg_look_begin(&p, table, kept, part, rows, kind);
    p.smallest = RG_BUDGET_WHOLE;
    bool ok = p.first >= 0;
    if (ok && table->is_of_textures)
        rg_look_textures(&p, &costs);
    else
        ok = ok && probe_cpu(&p) && learn_devices(&p, &known);
    if (ok && !table->is_of_textures)
        learn_works(&p, &known);
    for (int row = 0; ok && row < table->row_count; row++) {
        if (!table->is_of_textures) {
            costs = (struct rg_budget_table){0};
            add_row(&p, p.rows[row] ? row : p.last, &known, &costs);
        }
        times[row] = time_of(&costs, kept->devices);
    }
    rg_result_free(&p.result);
    return ok;
}

void rg_budget_alike(const struct rg_table *table, const struct rg_budget_table *other,
                     struct rg_budget_table *costs)
{
    name_costs(table, costs);
    memcpy(costs->cells, other->cells, sizeof(costs->cells));
    memcpy(costs->check_s, other->check_s, sizeof(costs->check_s));
}
