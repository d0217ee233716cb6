#include "harness/tables/runs/probe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/measure/sampling.h"
#include "harness/tables/runs/cell.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/measuring/measure.h"

// --- what is opened ---

struct probe {
    double open_ms, frame_ms;
};

// What is shared by the instances of a device is made when the first is opened, and lives as long
// as one is kept. The second frame is the one that is timed: drivers compile in the first.
static bool probe_subject(struct rg_kept *kept, struct rg_device *device,
                          const struct rg_subject *subject, struct probe *probe)
{
    const double start = rg_now_ms();
    struct rg_session *session = device ? rg_session_run(device, subject, 1) : NULL;
    if (!session)
        return false;
    const double opened = rg_now_ms();
    const bool ok = rg_session_frames(session, 1, &probe->frame_ms);
    probe->open_ms = fmax(opened - start - probe->frame_ms, 0);
    rg_kept_put(kept, session);
    return ok;
}

// A table, while its cells are probed.
struct probing {
    const struct rg_table *table;
    struct rg_kept *kept;
    struct rg_result result;
    enum rg_budget_size smallest;
    int rows[2]; // the first and the last that are needed
    struct rg_budget_kind *kind;
    struct rg_device *cpu;
    struct rg_frames of_cpu, last_of_cpu; // of both rows, and of the last
};

// The settings of a row, with some over them; the caller frees them. NULL, and one logged line, on
// failure.
static void *settings_of(const struct probing *p, int row, const char *over)
{
    const struct rg_technique *technique = rg_technique_find(p->table->technique);
    const struct rg_place at = {.row = row};
    char *assignments = rg_table_assignments(&p->result, p->table, at);
    void *defaults = rg_settings_create(technique), *of_row = NULL, *settings = NULL;
    if (defaults && assignments)
        of_row = rg_settings_copy(technique, defaults, assignments);
    if (of_row)
        settings = rg_settings_copy(technique, of_row, over);
    free(of_row);
    free(defaults);
    free(assignments);
    return settings;
}

static bool probe_row(struct probing *p, struct rg_device *device, int row,
                      enum rg_budget_size size, const char *over, struct probe *probe)
{
    static const int divisors[] = {4, 2, 1};
    void *settings = settings_of(p, row, over);
    const struct rg_subject subject = {rg_technique_find(p->table->technique), settings,
                                       p->table->width / divisors[size],
                                       p->table->height / divisors[size]};
    const bool ok = settings && probe_subject(p->kept, device, &subject, probe);
    free(settings);
    return ok;
}

// The last row at the smallest size, and at the next.
static bool probe_device(struct probing *p, struct rg_device *device, struct rg_frames *frames)
{
    static const double pixels[] = {1 / 16.0, 1 / 4.0, 1};
    const enum rg_budget_size smallest = p->smallest;
    struct probe small, larger;
    double a_pixel = 0;
    if (!probe_row(p, device, p->rows[1], smallest, "", &small))
        return false;
    frames->open_ms = small.open_ms;
    if (smallest < RG_BUDGET_WHOLE) {
        if (!probe_row(p, device, p->rows[1], smallest + 1, "", &larger))
            return false;
        a_pixel =
            fmax(larger.frame_ms - small.frame_ms, 0) / (pixels[smallest + 1] - pixels[smallest]);
        frames->open_ms = fmin(small.open_ms, larger.open_ms);
    }
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        frames->frame_ms[size] =
            small.frame_ms + a_pixel * fmax(pixels[size] - pixels[smallest], 0);
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
    struct rg_frames ratio = {a->open_ms / fmax(b->open_ms, 0.1), {0}};
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        ratio.frame_ms[size] = a->frame_ms[size] / fmax(b->frame_ms[size], 1e-3);
    return ratio;
}

static struct rg_frames scaled(const struct rg_frames *cpu, const struct rg_frames *ratio)
{
    struct rg_frames frames = {cpu->open_ms * ratio->open_ms, {0}};
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        frames.frame_ms[size] = cpu->frame_ms[size] * ratio->frame_ms[size];
    return frames;
}

// The frames of a device: by the ratio that is known of its technique, or found now.
static bool find_frames(struct probing *p, struct rg_device *device, struct rg_frames *frames)
{
    if (device == p->cpu) {
        *frames = p->of_cpu;
        return true;
    }
    struct rg_frames *ratio = of_kind(p->kind, device, p->kept), found;
    if (!(ratio->frame_ms[RG_BUDGET_WHOLE] > 0)) {
        if (!device || !probe_device(p, device, &found))
            return false;
        *ratio = ratio_of(&found, &p->last_of_cpu);
    }
    *frames = scaled(&p->of_cpu, ratio);
    return true;
}

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
    const bool is_small = table->is_of_textures || table->width * table->height <= SMALL_PIXELS;
    *costs = (struct rg_budget_table){.rows = rg_quick_rows(table, rows),
                                      .needed_rows = rg_needed_rows(table, needed),
                                      .needed_variants = rg_needed_variants(table, variants),
                                      .has_claims = rg_has_claims(table),
                                      .smallest = is_small ? RG_BUDGET_WHOLE : RG_BUDGET_FOURTH,
                                      .due = is_small || rg_needs_size(table) ? RG_BUDGET_WHOLE
                                                                              : RG_BUDGET_FOURTH};
    while (costs->variants < RG_TABLE_VARIANTS && table->variants[costs->variants].name)
        costs->variants++;
    while (costs->works < RG_TABLE_WORKS && table->works[costs->works].name)
        costs->works++;
    costs->works += !costs->works;
}

// The first row differs from the last by the same factor at each size.
static bool probe_cpu(struct probing *p)
{
    struct probe first;
    p->cpu = rg_kept_device(p->kept, "cpu");
    if (!p->cpu || !probe_device(p, p->cpu, &p->last_of_cpu))
        return false;
    p->of_cpu = p->last_of_cpu;
    if (p->rows[0] == p->rows[1])
        return true;
    if (!probe_row(p, p->cpu, p->rows[0], p->smallest, "", &first))
        return false;
    const double more = first.frame_ms / fmax(p->last_of_cpu.frame_ms[p->smallest], 1e-3);
    p->of_cpu.open_ms = fmin(p->of_cpu.open_ms, first.open_ms);
    for (int size = 0; size < RG_BUDGET_SIZES; size++)
        p->of_cpu.frame_ms[size] *= (1 + more) / 2;
    return true;
}

// The picture that cells must show, the same without rain, and how far it is from the truth.
static bool probe_check(struct probing *p, struct rg_budget_table *costs)
{
    const struct rg_table *table = p->table;
    const int frames = rg_budget_check_frames(table);
    struct rg_frames of_reference;
    struct probe truth = {0}, dry;
    if (!find_frames(p, rg_kept_device(p->kept, "cpu:reference"), &of_reference) ||
        !probe_row(p, p->cpu, p->rows[1], p->smallest,
                   rg_technique_find(table->technique)->proof->dry, &dry) ||
        (table->truth && !probe_row(p, p->cpu, p->rows[0], p->smallest, table->truth, &truth)))
        return false;
    // Without rain a frame takes less, on cpu:reference by the same factor as on cpu.
    const double dry_share = dry.frame_ms / fmax(p->last_of_cpu.frame_ms[p->smallest], 1e-3);
    const double a_pixel_ms = table->truth ? rg_budget_compare_ms() : 0;
    for (int size = 0; size < RG_BUDGET_SIZES; size++) {
        const double larger = p->of_cpu.frame_ms[size] / p->of_cpu.frame_ms[p->smallest];
        costs->check_s[size] =
            1e-3 *
            (2 * of_reference.open_ms + (1 + dry_share) * frames * of_reference.frame_ms[size] +
             truth.open_ms + frames * truth.frame_ms * larger +
             a_pixel_ms * table->width * table->height / (1 << 2 * (2 - size)));
    }
    return true;
}

static struct rg_budget_cost cost_of(const struct probing *p, double open_ms, double frame_ms)
{
    const struct rg_measure_options *all = rg_table_options(p->result.full);
    const struct rg_sampling sampling =
        rg_sampling_of(fmax(frame_ms, 1e-3), p->table->window_frames, all);
    return (struct rg_budget_cost){
        1e-3 * rg_budget_cell_ms(p->table, open_ms, frame_ms, rg_table_few_samples()),
        1e-3 * rg_budget_cell_ms(p->table, open_ms, frame_ms, all),
        1e-3 * rg_sampling_ms(&sampling, frame_ms)};
}

static void probe_cells(struct probing *p, struct rg_budget_table *costs)
{
    for (int d = 0; d < p->kept->devices->count; d++) {
        struct rg_frames frames;
        if (!find_frames(p, p->kept->devices->devices[d], &frames))
            continue;
        for (int size = 0; size < RG_BUDGET_SIZES; size++)
            costs->cells[d][size] = cost_of(p, frames.open_ms, frames.frame_ms[size]);
    }
}

// How many of a table's cells on a device open an instance: those that follow one with the same
// settings have it open, and take nothing.
static int openings(const struct probing *p, const struct rg_budget_table *costs)
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
static void probe_textures(struct probing *p, struct rg_budget_table *costs)
{
    const double share = (double)openings(p, costs) / (costs->rows * costs->variants);
    for (int d = 0; d < p->kept->devices->count; d++) {
        void *settings = settings_of(p, p->rows[0], "");
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
    struct probing p = {.table = table, .kept = kept, .kind = kind};
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
