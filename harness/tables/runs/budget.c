#include "harness/tables/runs/budget.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/runs/closing.h"
#include "harness/tables/runs/left.h"
#include "harness/tables/runs/needed.h"

struct budget {
    const struct rg_regenerate_options *options;
    const struct rg_devices *devices;
    struct rg_kept kept;
    struct rg_order_devices bits;
    int count;
    struct rg_standing *standings; // one per table, like the next two
    struct rg_result *results;     // the measured results
    struct rg_left_why *whys;      // why the first omitted part was left out
    double end_ms;                 // by rg_now_ms
    enum rg_turn told;             // the turn that was logged last; RG_TURNS: none
};

static double left_s(const struct budget *b)
{
    return (b->end_ms - rg_now_ms()) / 1000;
}

// cpu is measured first, and cpu:reference last, unless it is the only device.
static struct rg_order_devices name_bits(const struct rg_devices *devices)
{
    struct rg_order_devices bits = {0};
    for (int d = 0; d < devices->count; d++) {
        const char *name = devices->devices[d]->info.name;
        bits.all |= 1u << d;
        bits.first |= !strcmp(name, "cpu") ? 1u << d : 0;
        bits.last |= !strcmp(name, "cpu:reference") ? 1u << d : 0;
    }
    bits.last = bits.last == bits.all ? 0 : bits.last;
    const unsigned others = bits.all & ~bits.last;
    bits.first = bits.first ? bits.first : others & (~others + 1);
    return bits;
}

// --- measuring a step ---

// Makes a copy of a table that has only the given share of it; with a `step` (NULL: none), only the
// variants and works that the step adds. The caller frees *quick, to which the copy points. False,
// and one logged line, without memory.
static bool view(const struct rg_table *table, const struct rg_share *share,
                 const struct rg_step *step, struct rg_table *seen, char **quick)
{
    const bool adds_variants = step && step->turn == RG_TURN_VARIANTS;
    const bool adds_works = step && step->turn == RG_TURN_WORKS;
    bool needed[RG_TABLE_VARIANTS];
    int variants = 0, works = 0;
    rg_needed_variants(table, needed);
    *seen = *table;
    for (int v = 0; v < RG_TABLE_VARIANTS && table->variants[v].name; v++)
        if (adds_variants ? !needed[v] : needed[v] || share->all_variants)
            seen->variants[variants++] = table->variants[v];
    seen->variants[variants].name = NULL;
    for (int w = 0; w < RG_TABLE_WORKS && table->works[w].name; w++)
        if (adds_works ? w > 0 : !w || share->all_works)
            seen->works[works++] = table->works[w];
    seen->works[works].name = NULL;
    seen->width /= share->divisor;
    seen->height /= share->divisor;
    seen->truth = rg_wants_truth(table, share->divisor) ? table->truth : NULL;
    seen->quick = *quick = rg_table_quick(table, share->divisor);
    return *quick;
}

static void begin_result(const struct budget *b, const struct rg_table *seen,
                         const struct rg_share *share, unsigned devices, struct rg_result *result)
{
    const struct rg_table_part all = {.last_row = seen->row_count - 1};
    struct rg_devices chosen = *b->devices;
    chosen.count = 0;
    for (int d = 0; d < b->devices->count; d++)
        if (devices >> d & 1)
            chosen.devices[chosen.count++] = b->devices->devices[d];
    *result = (struct rg_result){0};
    rg_table_begin(result, seen, &all, &chosen);
    result->budget_s = b->options->budget_s;
    result->size_divisor = share->divisor;
    result->few_samples = !share->all_samples;
}

// Whether a step measures this row.
static bool wants(const struct budget *b, const struct rg_step *step, int row)
{
    const struct rg_table *table = b->standings[step->table].table;
    bool rows[RG_TABLE_ROWS];
    const bool is_there = rg_result_has(&b->results[step->table], row);
    if (step->turn == RG_TURN_ROWS)
        rg_quick_rows(table, rows);
    else
        rg_needed_rows(table, rows);
    const bool adds = step->turn <= RG_TURN_NEEDED || step->turn == RG_TURN_ROWS;
    return adds ? rows[row] && !is_there : is_there;
}

static int rows_of(const struct rg_result *result)
{
    int rows = 0;
    for (int row = result->first_row; row <= result->last_row; row++)
        rows += rg_result_has(result, row);
    return rows;
}

// Measures a step's part of its table. False without memory.
static bool measure(struct budget *b, const struct rg_step *step, const struct rg_table *seen,
                    struct rg_result *part)
{
    // Texture levels take no time once a texture is open.
    const bool has_part = step->turn == RG_TURN_FIRST && !seen->is_of_textures;
    const double part_s = has_part ? rg_order_part_s(b->standings, b->count, left_s(b)) : left_s(b);
    const struct rg_table_deadline deadline = {rg_now_ms() + 1000 * part_s, b->end_ms,
                                               rg_turn_is_whole(step->turn)};
    begin_result(b, seen, &step->share, step->devices, part);
    for (int row = 0; row < seen->row_count; row++)
        part->left_out[row] = !wants(b, step, row);
    return rg_table_measure(part, seen, &b->kept, NULL, NULL, &deadline);
}

// --- joining results ---

// Adds a measured part to the table's result, or replaces it. False, with one logged line, without
// memory.
static bool join(struct budget *b, const struct rg_step *step, const struct rg_table *seen,
                 const struct rg_result *part)
{
    struct rg_result *old = &b->results[step->table], joined;
    bool ok = true;
    begin_result(b, seen, &step->share, step->share.devices, &joined);
    for (int row = 0; ok && row < seen->row_count; row++) {
        const bool is_there = rg_result_has(part, row) || rg_result_has(old, row);
        joined.left_out[row] = !is_there;
        ok = !is_there || rg_table_add_row(&joined, seen, row);
    }
    if (ok) {
        rg_result_take(&joined, old);
        rg_result_take(&joined, part);
    }
    if (ok)
        rg_result_free(old);
    else
        rg_result_free(&joined);
    if (ok)
        *old = joined;
    return ok;
}

// Accepts a step's part, which took `seconds`, if it is complete where it has to be.
static bool take(struct budget *b, const struct rg_step *step, const struct rg_result *part,
                 double seconds)
{
    struct rg_standing *s = &b->standings[step->table];
    const int rows = rows_of(part);
    if (rows)
        rg_order_learn(b->standings, b->count, step,
                       rows * rg_result_row_cells(part) / part->device_count, seconds);
    if (!rows || (rg_turn_is_whole(step->turn) && rows < s->rows)) {
        rg_left_why(&b->whys[step->table], b->devices, step, seconds, -1);
        return true;
    }
    struct rg_table seen;
    char *quick = NULL;
    const bool ok = view(s->table, &step->share, NULL, &seen, &quick) && join(b, step, &seen, part);
    free(quick);
    s->share = ok ? step->share : s->share;
    s->rows = rows_of(&b->results[step->table]);
    return ok;
}

static void tell_turn(struct budget *b, enum rg_turn turn)
{
    char text[RG_DURATION_TEXT];
    if (turn != b->told)
        rg_info("within the budget, of which %s are left: %s",
                rg_duration_text(fmax(left_s(b), 0), text), rg_turn_about(turn));
    b->told = turn;
}

// False if the budget run has to end, for lack of memory.
static bool do_step(struct budget *b, const struct rg_step *step)
{
    struct rg_result part = {0};
    struct rg_table seen;
    char *quick = NULL;
    const double start_ms = rg_now_ms();
    bool ok = view(b->standings[step->table].table, &step->share, step, &seen, &quick);
    tell_turn(b, step->turn);
    ok = ok && measure(b, step, &seen, &part);
    rg_order_tried(b->standings, step);
    if (ok && !rg_interrupted())
        ok = take(b, step, &part, (rg_now_ms() - start_ms) / 1000);
    rg_result_free(&part);
    free(quick);
    return ok;
}

// Logs an error if the first row was late, since nothing fits then. A row of several variants ended
// after the first that was late, so the time of the others is extrapolated.
static bool first_fits(struct budget *b, const struct rg_step *step, double start_ms)
{
    const double now_ms = rg_now_ms(), begin_ms = b->options->begin_ms;
    const int parts = b->results[step->table].rows[0] ? 1 : step->cells;
    if (now_ms <= b->end_ms || rg_interrupted())
        return true;
    const double needed_s = ceil((start_ms - begin_ms + parts * (now_ms - start_ms)) / 1000);
    const struct rg_table *table = b->standings[step->table].table;
    return rg_error("--budget: a first row, of %s, is done %.0f s after the start, so that nothing "
                    "fits into %g s; give %.0fs or more, or name other tables",
                    table->id, needed_s, b->options->budget_s, needed_s);
}

// Measures until time is over. False, with one logged line, without memory or if nothing fits.
static bool run(struct budget *b)
{
    struct rg_step step;
    bool ok = true, is_first = true;
    while (ok && !rg_interrupted() && (is_first || left_s(b) > 0) &&
           rg_order_next(b->standings, b->count, &b->bits, left_s(b), &step)) {
        const double start_ms = rg_now_ms();
        if (!is_first && step.expected_s >= left_s(b)) {
            rg_left_why(&b->whys[step.table], b->devices, &step, step.expected_s, left_s(b));
            rg_order_tried(b->standings, &step);
            continue;
        }
        ok = do_step(b, &step) && (!is_first || first_fits(b, &step, start_ms));
        is_first = false;
    }
    return ok;
}

// --- the end ---

static int print_all(struct budget *b, struct rg_closing *closing)
{
    int exit = RG_EXIT_PASS;
    for (int i = 0; i < b->count; i++) {
        struct rg_place any = rg_result_start(&b->results[i]);
        if (!b->standings[i].rows || !rg_result_next(&b->results[i], &any))
            continue;
        rg_closing_add(closing, &b->results[i]);
        exit = rg_exit_worse(exit, b->options->print(&b->results[i], b->options->user));
    }
    if (b->options->print_end)
        exit = rg_exit_worse(exit, b->options->print_end(b->options->user));
    return exit;
}

static int finish(struct budget *b, FILE *out)
{
    struct rg_closing closing = {0};
    int exit = print_all(b, &closing);
    exit = rg_exit_with(exit, rg_closing_measured(&closing));
    if (rg_interrupted())
        return rg_exit_worse(exit, RG_EXIT_SIGNALLED + rg_interrupt_signal());
    fprintf(out, "took %.0f s, of a budget of %.0f s; left out, for time:\n",
            b->options->budget_s - left_s(b), b->options->budget_s);
    rg_left_tell(b->standings, b->results, b->whys, b->count, b->devices, out);
    rg_closing_tell(&closing, b->devices->count);
    return exit;
}

static bool begin(struct budget *b, const struct rg_table *const tables[])
{
    b->standings = rg_alloc((size_t)b->count, sizeof(*b->standings), "budget");
    b->results = rg_alloc((size_t)b->count, sizeof(*b->results), "budget");
    b->whys = rg_alloc((size_t)b->count, sizeof(*b->whys), "budget");
    for (int i = 0; b->standings && i < b->count; i++)
        b->standings[i] = rg_standing_of(tables[i]);
    return b->standings && b->results && b->whys;
}

int rg_tables_within(const struct rg_table *const tables[], int count,
                     const struct rg_devices *devices, const struct rg_regenerate_options *options,
                     FILE *out)
{
    struct budget b = {.options = options,
                       .devices = devices,
                       .kept = {.devices = devices},
                       .bits = name_bits(devices),
                       .count = count,
                       .told = RG_TURNS,
                       .end_ms = options->begin_ms + 1000 * options->budget_s};
    rg_interrupt_watch();
    rg_progress_told();
    const int exit = begin(&b, tables) && run(&b) ? finish(&b, out) : rg_exit_of_error();
    for (int i = 0; b.results && i < count; i++)
        rg_result_free(&b.results[i]);
    free(b.standings);
    free(b.results);
    free(b.whys);
    return rg_kept_free(&b.kept) ? exit : rg_exit_worse(exit, RG_EXIT_FAIL);
}
