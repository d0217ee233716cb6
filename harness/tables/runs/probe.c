#include "harness/tables/runs/probe.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/console/clock.h"
#include "harness/measure/sampling.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/runs/look.h"
#include "harness/tables/runs/needed.h"

static void find_ends(const struct rg_table *table, int rows[2])
{
    bool needed[RG_TABLE_ROWS];
    rg_needed_rows(table, needed);
    rows[0] = 0;
    for (int row = 0; row < table->row_count; row++)
        rows[1] = needed[row] ? row : rows[1];
}

static void name_costs(const struct rg_table *table, struct rg_budget_table *costs)
{
    enum { SMALL_PIXELS = 512 * 512 };
    bool needed[RG_TABLE_ROWS], rows[RG_TABLE_ROWS], variants[RG_TABLE_VARIANTS];
    const bool is_small = rg_needs_size(table) || table->width * table->height <= SMALL_PIXELS;
    *costs = (struct rg_budget_table){.rows = rg_quick_rows(table, rows),
                                      .needed_rows = rg_needed_rows(table, needed),
                                      .needed_variants = rg_needed_variants(table, variants),
                                      .has_claims = rg_has_claims(table),
                                      .smallest = is_small ? RG_BUDGET_WHOLE : RG_BUDGET_FOURTH};
    while (costs->variants < RG_TABLE_VARIANTS && table->variants[costs->variants].name)
        costs->variants++;
    while (costs->works < RG_TABLE_WORKS && table->works[costs->works].name)
        costs->works++;
    costs->works += !costs->works;
}

// The last row on cpu. How a larger picture takes longer is known once a table of the technique was
// looked at.
static bool probe_last(struct rg_looking *p)
{
    struct rg_budget_kind *kind = p->kind;
    struct rg_cell_frames last;
    if (!kind->is_known)
        return rg_look_device(p, p->cpu, &p->last_of_cpu);
    if (!rg_look_row(p, p->cpu, p->rows[1], p->smallest, "", &last))
        return false;
    p->last_of_cpu = (struct rg_frames){.open_ms = last.open_ms, .step_ms = last.step_ms};
    p->last_of_cpu.frame_ms[p->smallest] = last.frame_ms;
    rg_look_extend(&p->last_of_cpu, p->smallest, kind->larger);
    return true;
}

// What holds of all tables of a technique: how a larger picture takes longer, and one without rain
// less.
static bool learn(struct rg_looking *p)
{
    struct rg_budget_kind *kind = p->kind;
    const double small_ms = fmax(p->last_of_cpu.frame_ms[p->smallest], 1e-3);
    const char *without = rg_technique_find(p->table->technique)->proof->dry;
    struct rg_cell_frames dry;
    if (kind->is_known)
        return true;
    if (!rg_look_row(p, p->cpu, p->rows[1], p->smallest, without, &dry))
        return false;
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        kind->larger[size] = p->last_of_cpu.frame_ms[size] / small_ms;
    kind->dry_share = dry.frame_ms / small_ms;
    return kind->is_known = true;
}

// The first row differs from the last by the same factor at each size.
static bool probe_cpu(struct rg_looking *p)
{
    struct rg_cell_frames first;
    p->cpu = rg_kept_device(p->kept, "cpu");
    if (!p->cpu || !probe_last(p) || !learn(p))
        return false;
    p->of_cpu = p->last_of_cpu;
    if (p->rows[0] == p->rows[1])
        return true;
    if (!rg_look_row(p, p->cpu, p->rows[0], p->smallest, "", &first))
        return false;
    const double more = first.frame_ms / fmax(p->last_of_cpu.frame_ms[p->smallest], 1e-3);
    p->of_cpu.open_ms = fmin(p->of_cpu.open_ms, first.open_ms);
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        p->of_cpu.frame_ms[size] *= (1 + more) / 2;
    return true;
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
    return kind->has_truth = (is_shown || rg_look_row(p, p->cpu, p->rows[0], p->smallest,
                                                      table->shown, &kind->shown)) &&
                             rg_look_row(p, p->cpu, p->rows[0], p->smallest, over, &kind->truth);
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

// The picture that cells must show, which cpu:reference draws; the same without rain, and the truth
// that it is compared with, which cpu does.
static bool probe_check(struct rg_looking *p, struct rg_budget_table *costs)
{
    const struct rg_table *table = p->table;
    struct rg_frames of_reference;
    if (!rg_look_frames(p, rg_kept_device(p->kept, "cpu:reference"), &of_reference) ||
        !learn_truth(p))
        return false;
    const double a_pixel_ms = table->truth ? rg_cell_compare_ms() : 0;
    for (int size = 0; size < RG_BUDGET_SIZES; size++) {
        const struct rg_cell_frames expected = at_size(&of_reference, size);
        struct rg_cell_frames dry = at_size(&p->of_cpu, size);
        dry.frame_ms *= p->kind->dry_share;
        costs->check_s[size] =
            1e-3 * (rg_cell_image_ms(table, &expected) + rg_cell_image_ms(table, &dry) +
                    error_ms(p, size, a_pixel_ms));
    }
    return true;
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

static void probe_cells(struct rg_looking *p, struct rg_budget_table *costs)
{
    for (int d = 0; d < p->kept->devices->count; d++) {
        struct rg_frames frames;
        if (!rg_look_frames(p, p->kept->devices->devices[d], &frames))
            continue;
        for (int size = 0; size < RG_BUDGET_SIZES; size++) {
            const struct rg_cell_frames f = at_size(&frames, size);
            costs->cells[d][size] = cost_of(p, &f);
        }
    }
}

// How many of a table's cells on a device open an instance: those that follow one with the same
// settings have it open, and take nothing.
static int openings(const struct rg_looking *p, const struct rg_budget_table *costs)
{
    char *before = NULL;
    int count = 0;
    for (int row = 0; row < costs->rows; row++) {
        for (int v = 0; v < costs->variants; v++) {
            const struct rg_place at = {.row = row, .variant = v};
            char *now = rg_table_assignments(&p->result, p->table, at);
            count += !before || !now || strcmp(before, now) != 0;
            free(before);
            before = now;
        }
    }
    free(before);
    return count;
}

// A texture's level takes nothing but opening what holds it.
static void probe_textures(struct rg_looking *p, struct rg_budget_table *costs)
{
    const double share = (double)openings(p, costs) / (costs->rows * costs->variants);
    for (int d = 0; d < p->kept->devices->count; d++) {
        void *settings = rg_look_settings(p, p->rows[0], RG_BUDGET_WHOLE, "");
        const struct rg_subject subject = {rg_technique_find(p->table->technique), settings,
                                           p->table->width, p->table->height};
        const double start = rg_now_ms();
        const bool ok = settings && rg_kept_open(p->kept, p->kept->devices->devices[d], &subject);
        const double a_cell_s = ok ? 1e-3 * share * (rg_now_ms() - start) : 0;
        free(settings);
        for (int size = 0; size < RG_BUDGET_SIZES; size++)
            costs->cells[d][size] = (struct rg_budget_cost){a_cell_s, a_cell_s, 0};
    }
}

bool rg_budget_probe(const struct rg_table *table, struct rg_kept *kept, bool full,
                     struct rg_budget_kind *kind, struct rg_budget_table *costs)
{
    const struct rg_table_part part = {.last_row = table->row_count - 1, .full = full};
    struct rg_looking p = {.table = table, .kept = kept, .kind = kind};
    name_costs(table, costs);
    p.smallest = full ? RG_BUDGET_WHOLE : costs->smallest;
    find_ends(table, p.rows);
    rg_table_begin(&p.result, table, &part, kept->devices);
    const bool ok = table->is_of_textures || (probe_cpu(&p) && probe_check(&p, costs));
    if (table->is_of_textures)
        probe_textures(&p, costs);
    else if (ok)
        probe_cells(&p, costs);
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
