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
#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/order.h"

// Why the first omitted part of a table was left out; "": no time was left.
struct why {
    char text[160];
};

struct budget {
    const struct rg_regenerate_options *options;
    const struct rg_devices *devices;
    struct rg_kept kept;
    struct rg_order order;
    struct rg_result *results; // the measured results, one per table, like the next
    struct why *whys;
    double end_ms;     // by rg_now_ms
    enum rg_turn told; // the turn that was logged last; RG_TURNS: none
};

static double left_s(const struct budget *b)
{
    return (b->end_ms - rg_now_ms()) / 1000;
}

// cpu is measured first, and cpu:reference last, unless it is the only device.
static void name_bits(struct rg_order *order, const struct rg_devices *devices)
{
    for (int d = 0; d < devices->count; d++) {
        const char *name = devices->devices[d]->info.name;
        order->all |= 1u << d;
        order->first |= !strcmp(name, "cpu") ? 1u << d : 0;
        order->last |= !strcmp(name, "cpu:reference") ? 1u << d : 0;
    }
    order->last = order->last == order->all ? 0 : order->last;
    const unsigned others = order->all & ~order->last;
    order->first = order->first ? order->first : others & (~others + 1);
}

static void name_devices(const struct budget *b, unsigned devices, char *text, size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int d = 0; d < b->devices->count; d++)
        if (devices >> d & 1 && used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                     b->devices->devices[d]->info.name);
}

// Notes why a step is left out, unless an earlier one of the table was: its expected time and the
// time left. A negative time left means that it began and did not end in time.
static void note_why(struct budget *b, const struct rg_step *step, double expected_s, double left_s)
{
    struct why *why = &b->whys[step->table];
    char on[96];
    if (*why->text)
        return;
    name_devices(b, step->devices, on, sizeof(on));
    const char *what = rg_turns[step->turn].of_devices ? on : rg_turns[step->turn].about;
    if (left_s < 0)
        snprintf(why->text, sizeof(why->text), "%s did not end in time", what);
    else
        snprintf(why->text, sizeof(why->text), "%s would take %.1f s, and %.1f s were left", what,
                 expected_s, left_s);
}

// --- measuring a step ---

// Makes a copy of a table with only this share of it, and of the share only the variants or works
// that the turn adds (RG_TURNS: all). The caller frees *quick, to which the copy points. False, and
// one logged line, without memory.
static bool view(const struct rg_table *table, const struct rg_share *share, enum rg_turn turn,
                 struct rg_table *seen, char **quick)
{
    bool needed[RG_TABLE_VARIANTS];
    int variants = 0, works = 0;
    rg_needed_variants(table, needed);
    *seen = *table;
    for (int v = 0; v < RG_TABLE_VARIANTS && table->variants[v].name; v++)
        if (turn == RG_TURN_VARIANTS ? !needed[v] : needed[v] || share->all_variants)
            seen->variants[variants++] = table->variants[v];
    seen->variants[variants].name = NULL;
    for (int w = 0; w < RG_TABLE_WORKS && table->works[w].name; w++)
        if (turn == RG_TURN_WORKS ? w > 0 : !w || share->all_works)
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
    result->few_samples = result->few_samples || !share->all_samples;
}

static int rows_of(const struct rg_result *result)
{
    int rows = 0;
    for (int row = result->first_row; row <= result->last_row; row++)
        rows += rg_result_has(result, row);
    return rows;
}

// Measures a step's rows: those that it adds, or those that are there. False without memory.
static bool measure(struct budget *b, const struct rg_step *step, const struct rg_table *seen,
                    struct rg_result *part)
{
    const struct rg_table_deadline deadline = {rg_now_ms() + 1000 * step->part_s, b->end_ms,
                                               rg_turns[step->turn].is_whole};
    const bool adds = step->turn <= RG_TURN_NEEDED || step->turn == RG_TURN_ROWS;
    bool rows[RG_TABLE_ROWS];
    (step->turn == RG_TURN_ROWS ? rg_quick_rows
                                : rg_needed_rows)(b->order.tables[step->table].table, rows);
    begin_result(b, seen, &step->share, step->devices, part);
    for (int row = 0; row < seen->row_count; row++) {
        const bool is_there = rg_result_has(&b->results[step->table], row);
        part->left_out[row] = adds ? is_there || !rows[row] : !is_there;
    }
    return rg_table_measure(part, seen, &b->kept, NULL, NULL, &deadline);
}

// Adds a measured part to the table's result, or replaces it. False, with one logged line, without
// memory.
static bool join(struct budget *b, const struct rg_step *step, const struct rg_result *part)
{
    struct rg_result *old = &b->results[step->table], joined;
    struct rg_table seen;
    char *quick = NULL;
    bool ok = view(b->order.tables[step->table].table, &step->share, RG_TURNS, &seen, &quick);
    begin_result(b, &seen, &step->share, step->share.devices, &joined);
    for (int row = 0; ok && row < seen.row_count; row++) {
        joined.left_out[row] = !rg_result_has(part, row) && !rg_result_has(old, row);
        ok = joined.left_out[row] || rg_table_add_row(&joined, &seen, row);
    }
    if (ok) {
        rg_result_take(&joined, old);
        rg_result_take(&joined, part);
        const struct rg_result replaced = *old;
        *old = joined;
        joined = replaced;
    }
    rg_result_free(&joined);
    free(quick);
    return ok;
}

// Accepts a step's part, which took `seconds`, if it is complete, or if its turn does not need
// that. False without memory.
static bool take(struct budget *b, const struct rg_step *step, const struct rg_result *part,
                 double seconds)
{
    struct rg_standing *s = &b->order.tables[step->table];
    const int rows = rows_of(part);
    if (rows)
        rg_order_learn(&b->order, step, rows * rg_result_row_cells(part) / part->device_count,
                       seconds);
    if (!rows || (rg_turns[step->turn].is_whole && rows < s->rows)) {
        note_why(b, step, seconds, -1);
        return true;
    }
    const bool ok = join(b, step, part);
    s->share = ok ? step->share : s->share;
    s->rows = rows_of(&b->results[step->table]);
    return ok;
}

// False if the budget run has to end, for lack of memory.
static bool do_step(struct budget *b, const struct rg_step *step)
{
    struct rg_result part = {0};
    struct rg_table seen;
    char *quick = NULL, text[RG_DURATION_TEXT];
    const double start_ms = rg_now_ms();
    if (step->turn != b->told)
        rg_info("within the budget, of which %s are left: %s",
                rg_duration_text(fmax(left_s(b), 0), text), rg_turns[step->turn].about);
    b->told = step->turn;
    bool ok = view(b->order.tables[step->table].table, &step->share, step->turn, &seen, &quick) &&
              measure(b, step, &seen, &part);
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
    return rg_error("--budget: a first row, of %s, is done %.0f s after the start, so that nothing "
                    "fits into %g s; give %.0fs or more, or name other tables",
                    b->order.tables[step->table].table->id, needed_s, b->options->budget_s,
                    needed_s);
}

// Measures until time is over. False, with one logged line, without memory or if nothing fits.
static bool run(struct budget *b)
{
    struct rg_step step;
    bool ok = true, is_first = true;
    while (ok && !rg_interrupted() && (is_first || left_s(b) > 0) &&
           rg_order_next(&b->order, left_s(b), &step)) {
        const double start_ms = rg_now_ms();
        if (!is_first && step.expected_s >= left_s(b)) {
            note_why(b, &step, step.expected_s, left_s(b));
            continue;
        }
        ok = do_step(b, &step) && (!is_first || first_fits(b, &step, start_ms));
        is_first = false;
    }
    return ok;
}

// --- the end ---

// Writes the rows that were not measured: "1, 4, 8-10".
static void name_rows(const struct rg_result *result, int count, char *text, size_t size)
{
    size_t used = 0;
    int from = -1;
    *text = 0;
    for (int row = 0; row <= count; row++) {
        const bool in = row < count && !rg_result_has(result, row);
        if (in && from < 0)
            from = row;
        if (in || from < 0)
            continue;
        if (used < size)
            used += (size_t)snprintf(text + used, size - used, "%s%d", used ? ", " : "", from + 1);
        if (row - from > 1 && used < size)
            used += (size_t)snprintf(text + used, size - used, "-%d", row);
        from = -1;
    }
}

// Prints the parts of a table that were not measured; false if nothing was left out.
static bool print_left_out(const struct budget *b, int table, FILE *out)
{
    const struct rg_standing *s = &b->order.tables[table];
    const struct rg_share *share = &s->share;
    const char *why = b->whys[table].text;
    char rows[256], devices[256], text[768] = "  all of it";
    name_rows(&b->results[table], s->table->row_count, rows, sizeof(rows));
    name_devices(b, ~share->devices, devices, sizeof(devices));
    if (s->rows)
        snprintf(text, sizeof(text), "%s%s%s%s%s%s%s%s", *rows ? "; rows " : "", rows,
                 !share->all_works && s->works > 1 ? "; works but what was printed" : "",
                 !share->all_variants && s->variants > s->needed_variants
                     ? "; variants that no claim is about"
                     : "",
                 share->divisor > 1 ? "; whole pictures" : "",
                 share->all_samples ? "" : "; more than 6 samples", *devices ? "; " : "", devices);
    if (*text)
        fprintf(out, "  %-16s %s%s%s%s\n", s->table->id, text + 2, *why ? " (" : "", why,
                *why ? ")" : "");
    return *text;
}

static int print_all(struct budget *b, struct rg_closing *closing)
{
    int exit = RG_EXIT_PASS;
    for (int i = 0; i < b->order.count; i++) {
        struct rg_place any = rg_result_start(&b->results[i]);
        if (!b->order.tables[i].rows || !rg_result_next(&b->results[i], &any))
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
    bool any = false;
    int exit = print_all(b, &closing);
    exit = rg_exit_with(exit, rg_closing_measured(&closing));
    if (rg_interrupted())
        return rg_exit_worse(exit, RG_EXIT_SIGNALLED + rg_interrupt_signal());
    fprintf(out, "took %.0f s, of a budget of %.0f s; left out, for time:\n",
            b->options->budget_s - left_s(b), b->options->budget_s);
    for (int i = 0; i < b->order.count; i++)
        any = print_left_out(b, i, out) || any;
    if (!any)
        fprintf(out, "  nothing\n");
    rg_closing_tell(&closing, b->devices->count);
    return exit;
}

static bool begin(struct budget *b, const struct rg_table *const tables[])
{
    const size_t count = (size_t)b->order.count;
    name_bits(&b->order, b->devices);
    b->order.tables = rg_alloc(count, sizeof(*b->order.tables), "budget");
    b->results = rg_alloc(count, sizeof(*b->results), "budget");
    b->whys = rg_alloc(count, sizeof(*b->whys), "budget");
    for (int i = 0; b->order.tables && i < b->order.count; i++)
        b->order.tables[i] = rg_standing_of(tables[i]);
    return b->order.tables && b->results && b->whys;
}

int rg_tables_within(const struct rg_table *const tables[], int count,
                     const struct rg_devices *devices, const struct rg_regenerate_options *options,
                     FILE *out)
{
    struct budget b = {.options = options,
                       .devices = devices,
                       .kept = {.devices = devices},
                       .order = {.count = count},
                       .told = RG_TURNS,
                       .end_ms = options->begin_ms + 1000 * options->budget_s};
    rg_interrupt_watch();
    rg_progress_told();
    const int exit = begin(&b, tables) && run(&b) ? finish(&b, out) : rg_exit_of_error();
    for (int i = 0; b.results && i < count; i++)
        rg_result_free(&b.results[i]);
    free(b.order.tables);
    free(b.results);
    free(b.whys);
    return rg_kept_free(&b.kept) ? exit : rg_exit_worse(exit, RG_EXIT_FAIL);
}
