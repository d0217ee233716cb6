// A table from its rows to their numbers, a batch of rows at a time.
#include "core/base/alloc.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/record/journal.h"
#include "harness/tables/table.h"

// Of fewer than 6 samples a median has no interval of 95 %.
static const struct rg_measure_options quick = {
    .most_samples = 15, .least_samples = 6, .sample_ms = 15, .cell_ms = 1000, .warm_up_ms = 250};
static const struct rg_measure_options full = {
    .most_samples = 61, .least_samples = 6, .sample_ms = 60, .cell_ms = 2000, .warm_up_ms = 500};

// How far a cell is: so much when it is prepared, and as much again when it is measured.
enum { CELL_UNITS = 1000 };

struct batch {
    struct rg_table_run *run;
    struct rg_kept *kept;
    struct rg_measure_options options;
    struct rg_progress progress;
    int first, last, cells;
    int64_t units; // of the bar, told for what is measured of this batch
};

static void show_round(int done, int total, void *user)
{
    struct batch *b = user;
    const int64_t units = (int64_t)CELL_UNITS * b->cells * done / total;
    rg_progress_add(&b->progress, units - b->units);
    b->units = units;
}

static void measure_batch(struct batch *b)
{
    const int variants = rg_table_variant_count(b->run->table), devices = b->run->devices->count;
    const bool is_timed = !b->run->table->is_of_textures;
    struct rg_cell *cells = rg_table_cell(b->run, b->first, 0, 0);
    b->cells = (b->last - b->first + 1) * variants * devices;
    b->units = 0;
    for (int i = 0; i < b->cells / devices && !rg_interrupted(); i++) {
        if (is_timed)
            rg_table_prepare(b->run, b->kept, b->first + i / variants, i % variants, &b->options);
        else
            rg_table_tell_texture(b->run, b->kept, b->first + i / variants, i % variants);
        rg_progress_add(&b->progress, CELL_UNITS * devices);
    }
    if (is_timed && !rg_interrupted())
        rg_cells_measure(cells, b->cells, &b->options);
    show_round(1, 1, b);
    for (int i = 0; i < b->cells; i++) {
        if (cells[i].instance)
            rg_kept_put(b->kept, cells[i].instance);
        cells[i].instance = NULL;
    }
}

// The last row of the batch that begins with `first`.
static int end_of_batch(const struct rg_table_run *run, const struct rg_journal *journal, int first)
{
    const int most = run->table->rows_at_once;
    int last = first;
    while (last < run->last_row && (!most || last - first + 1 < most) &&
           !rg_journal_has(journal, last + 1))
        last++;
    return last;
}

static void leave_out(struct rg_table_run *run, int first)
{
    const int variants = rg_table_variant_count(run->table);
    for (int row = first; row <= run->last_row; row++)
        for (int variant = 0; variant < variants; variant++)
            rg_table_group(run, row, variant)->is_missing = true;
}

static bool create_cells(struct rg_table_run *run)
{
    const int rows = run->last_row - run->first_row + 1;
    const int groups = rows * rg_table_variant_count(run->table);
    const int cells = groups * run->devices->count;
    run->cells = rg_alloc((size_t)cells, sizeof(*run->cells), run->table->id);
    run->groups = rg_alloc((size_t)groups, sizeof(*run->groups), run->table->id);
    if (run->cells && run->groups)
        run->cell_count = cells;
    return run->cell_count == cells;
}

bool rg_table_measure(struct rg_table_run *run, struct rg_kept *kept, struct rg_journal *journal)
{
    struct batch b = {.run = run, .kept = kept, .options = run->full ? full : quick};
    if (!create_cells(run))
        return false;
    b.options.progress = show_round;
    b.options.user = &b;
    rg_progress_start(&b.progress, (int64_t)2 * CELL_UNITS * run->cell_count);
    const int64_t row_units =
        2 * CELL_UNITS * run->cell_count / (run->last_row - run->first_row + 1);
    for (b.first = run->first_row; b.first <= run->last_row; b.first = b.last + 1) {
        b.last = b.first;
        if (rg_journal_take(journal, run, b.first)) {
            run->resumed_rows++;
            rg_progress_add(&b.progress, row_units);
            continue;
        }
        b.last = end_of_batch(run, journal, b.first);
        rg_progress_label(&b.progress, "%s, rows %d-%d", run->table->id, b.first + 1, b.last + 1);
        measure_batch(&b);
        if (rg_interrupted()) {
            leave_out(run, b.first);
            break;
        }
        rg_journal_add(journal, run, b.first, b.last);
    }
    rg_progress_end(&b.progress);
    return true;
}
