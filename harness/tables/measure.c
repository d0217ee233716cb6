// A table from its rows to their numbers, a batch of rows at a time.
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/measure/calibration.h"
#include "harness/tables/batch.h"

// Of fewer than 6 samples a median has no interval of 95 %.
static const struct rg_measure_options quick = {.most_samples = 15,
                                                .least_samples = 6,
                                                .sample_ms = 15,
                                                .job_ms = 1000,
                                                .warm_up_ms = 250,
                                                .load = rg_calibration_load};
static const struct rg_measure_options full = {.most_samples = 61,
                                               .least_samples = 6,
                                               .sample_ms = 60,
                                               .job_ms = 2000,
                                               .warm_up_ms = 500,
                                               .load = rg_calibration_load};

static const struct rg_measure_options few = {.most_samples = 6,
                                              .least_samples = 6,
                                              .sample_ms = 15,
                                              .warm_up_ms = 100,
                                              .load = rg_calibration_load};

const struct rg_measure_options *rg_table_few_samples(void)
{
    return &few;
}

const struct rg_measure_options *rg_table_options(bool is_full)
{
    return is_full ? &full : &quick;
}

// How far a cell is: so much when it is prepared, and as much again when it is measured.
enum { CELL_UNITS = 1000 };

struct measuring {
    struct rg_result *result;
    const struct rg_table *table;
    struct rg_kept *kept;
    struct rg_measure_options options;
    struct rg_progress progress;
    int first, last; // rows of the batch
    int cells;       // of the batch
    int64_t units;   // of the bar, told for what is measured of this batch
};

static void show_round(int done, int total, void *user)
{
    struct measuring *m = user;
    const int64_t units = (int64_t)CELL_UNITS * m->cells * done / total;
    rg_progress_add(&m->progress, units - m->units);
    m->units = units;
}

static void prepare(struct measuring *m, struct rg_batch *batch, int row)
{
    for (struct rg_place at = rg_result_start_row(row);
         rg_result_next_in_row(m->result, &at) && !rg_interrupted();) {
        if (at.device == 0 && m->result->is_of_textures)
            rg_batch_tell_texture(batch, at);
        else if (at.device == 0)
            rg_batch_prepare(batch, at, &m->options);
        rg_progress_add(&m->progress, CELL_UNITS);
    }
}

static void settle(struct measuring *m)
{
    for (int row = m->first; row <= m->last; row++)
        for (struct rg_place at = rg_result_start_row(row);
             rg_result_has(m->result, row) && rg_result_next_in_row(m->result, &at);)
            rg_record_settle(rg_result_at(m->result, at));
}

static bool add_rows(struct measuring *m)
{
    bool ok = true;
    for (int row = m->first; ok && row <= m->last; row++)
        ok = !rg_result_wants(m->result, row) || rg_table_add_row(m->result, m->table, row);
    return ok;
}

static bool measure_batch(struct measuring *m)
{
    struct rg_batch batch = {.result = m->result, .table = m->table, .kept = m->kept};
    m->cells = (m->last - m->first + 1) * rg_result_row_cells(m->result);
    m->units = 0;
    const bool ok = add_rows(m) && rg_batch_open(&batch, m->last - m->first + 1);
    for (int row = m->first; ok && row <= m->last; row++)
        if (rg_result_wants(m->result, row))
            prepare(m, &batch, row);
    if (ok && !rg_interrupted())
        rg_jobs_measure(batch.jobs, batch.job_count, &m->options);
    show_round(1, 1, m);
    if (ok)
        settle(m);
    rg_batch_close(&batch);
    return ok;
}

// The last row of the batch that begins with the first.
static int end_of_batch(const struct measuring *m, const struct rg_journal *journal)
{
    const int most = m->table->rows_at_once;
    int last = m->first;
    while (last < m->result->last_row && (!most || last - m->first + 1 < most) &&
           !rg_journal_has(journal, last + 1))
        last++;
    return last;
}

// Takes a row from the journal, or measures those that follow. False without memory.
static bool measure_next(struct measuring *m, struct rg_journal *journal, int64_t row_units)
{
    m->last = m->first;
    if (!rg_result_wants(m->result, m->first))
        return true;
    if (rg_journal_has(journal, m->first) && add_rows(m) &&
        rg_journal_take(journal, m->result, m->first)) {
        m->result->resumed_rows++;
        rg_progress_add(&m->progress, row_units);
        return true;
    }
    m->last = end_of_batch(m, journal);
    rg_progress_label(&m->progress, "%s, rows %d-%d", m->table->id, m->first + 1, m->last + 1);
    if (!measure_batch(m))
        return false;
    for (int row = m->first; rg_interrupted() && row <= m->last; row++)
        rg_result_drop_row(m->result, row);
    if (!rg_interrupted())
        rg_journal_add(journal, m->result, m->first, m->last);
    return true;
}

// Where cells take longer than a budget has them, the rows that are left when it ends are left out.
static void leave_out_late(struct measuring *m)
{
    struct rg_result *result = m->result;
    if (result->budget_end_ms <= 0 || rg_now_ms() < result->budget_end_ms)
        return;
    for (int row = m->first; row <= result->last_row; row++)
        result->left_out[row - result->first_row] = true;
}

bool rg_table_measure(struct rg_result *result, const struct rg_table *table, struct rg_kept *kept,
                      struct rg_journal *journal)
{
    struct measuring m = {.result = result,
                          .table = table,
                          .kept = kept,
                          .options = result->full          ? full
                                     : result->few_samples ? few
                                                           : quick,
                          .first = result->first_row};
    const int64_t row_units = (int64_t)2 * CELL_UNITS * rg_result_row_cells(result);
    m.options.progress = show_round;
    m.options.user = &m;
    int rows = 0;
    for (int row = result->first_row; row <= result->last_row; row++)
        rows += rg_result_wants(result, row);
    rg_progress_start(&m.progress, row_units * rows);
    bool ok = true;
    for (; ok && m.first <= result->last_row && !rg_interrupted(); m.first = m.last + 1) {
        leave_out_late(&m);
        ok = measure_next(&m, journal, row_units);
    }
    rg_progress_end(&m.progress);
    return ok;
}
