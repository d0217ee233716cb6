// A table from its rows to their numbers. As many rows as memory holds are open together and are
// visited in turn. Where it does not hold all, each group of rows is visited several times, so that
// what disturbs the machine for a while disturbs no row alone.
#include "core/base/memory.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/tables/measuring/batch.h"
#include "harness/tables/measuring/measure.h"

// So often is each group of rows visited, where there are several.
enum { VISITS = 3 };
// More buffers and images than any technique's instance has.
enum { OBJECTS_AN_INSTANCE = 100 };
// What is measured is kept on disk so often.
#define KEEP_EVERY_MS 30000

// Rows that are open together, and their jobs in the batch.
struct group {
    int first_row, last_row;
    int first_job, job_count;
    int64_t units; // of the bar, for its samples
};

struct measuring {
    struct rg_result *result;
    const struct rg_table *table;
    struct rg_kept *kept;
    struct rg_journal *journal;
    struct rg_measure_options options;
    struct rg_table_bar bar;
    struct rg_batch batch;
    struct group groups[RG_TABLE_ROWS];
    int group_count;
    struct group *now; // the group that is visited
    double share;      // of its samples, which this visit takes
    int64_t units;     // of the bar, told for what was sampled in this visit
    double kept_ms;    // when something was kept last
    int64_t available; // memory, when the group was begun, in bytes
};

// --- what was measured is told, and kept ---

static void keep(struct measuring *m)
{
    for (int row = m->now->first_row; row <= m->now->last_row; row++)
        for (struct rg_place at = rg_result_start_row(row);
             rg_result_has(m->result, row) && rg_result_next_in_row(m->result, &at);)
            rg_record_settle(rg_result_at(m->result, at));
    rg_journal_add(m->journal, m->result, m->now->first_row, m->now->last_row);
    m->kept_ms = rg_now_ms();
}

static void show_share(double share, void *user)
{
    struct measuring *m = user;
    const int64_t units = (int64_t)((double)m->now->units * m->share * share);
    rg_progress_add(m->bar.progress, units - m->units);
    m->units = units;
    if (share < 1 && rg_now_ms() - m->kept_ms > KEEP_EVERY_MS)
        keep(m);
}

// --- rows are opened ---

// What the cell with this number, from 1, has of a row's units.
static int64_t share_of(int64_t units, int64_t cell, const struct rg_result *result)
{
    const int64_t cells = rg_result_row_cells(result);
    return units * cell / cells - units * (cell - 1) / cells;
}

// What samples of jobs take, and what opening these again for further visits does.
static double samples_ms(const struct measuring *m, const struct rg_job *jobs, int count,
                         int visits)
{
    double ms = rg_jobs_expected_ms(jobs, count, &m->options);
    for (int i = 0; i < count; i++)
        if (jobs[i].record->outcome == RG_OK)
            ms += (visits - 1) *
                  (jobs[i].record->create_ms + jobs[i].check_frames * jobs[i].warm_frame_ms);
    return ms;
}

// What a row took to open, and what its samples will take, tells of the rows that are left.
static void learn(struct measuring *m, int row, int64_t shown, double ms, int first_job)
{
    const struct rg_job *jobs = m->batch.jobs + first_job;
    const double sampling_ms = samples_ms(m, jobs, m->batch.job_count - first_job, 1);
    rg_table_bar_correct(&m->bar, shown, ms);
    rg_table_bar_learn(&m->bar, RG_BAR_OPENING,
                       rg_table_row_units(m->result, &m->bar, row, RG_BAR_OPENING), ms);
    rg_table_bar_learn(&m->bar, RG_BAR_SAMPLING,
                       rg_table_row_units(m->result, &m->bar, row, RG_BAR_SAMPLING), sampling_ms);
}

static void prepare(struct measuring *m, int row)
{
    const int64_t units = rg_table_row_units(m->result, &m->bar, row, RG_BAR_OPENING);
    const int64_t shown = rg_table_bar_begin(&m->bar, RG_BAR_OPENING, units);
    const double start_ms = rg_now_ms();
    const int first_job = m->batch.job_count;
    int64_t cells = 0;
    rg_progress_label(m->bar.progress, "%s, row %d", m->table->id, row + 1);
    for (struct rg_place at = rg_result_start_row(row);
         rg_result_next_in_row(m->result, &at) && !rg_interrupted();) {
        if (at.device == 0 && m->result->is_of_textures)
            rg_batch_tell_texture(&m->batch, at);
        else if (at.device == 0)
            rg_batch_prepare(&m->batch, at, &m->options);
        rg_progress_add(m->bar.progress, share_of(shown, ++cells, m->result));
    }
    if (!rg_interrupted())
        learn(m, row, shown, rg_now_ms() - start_ms, first_job);
}

// Takes a row that an earlier run measured. False where it has to be measured now; a part of it may
// be there then.
static bool take_row(struct measuring *m, int row)
{
    if (!rg_journal_take(m->journal, m->result, row))
        return false;
    m->result->resumed_rows++;
    return rg_result_is_whole(m->result, row);
}

// Where cells take longer than a budget has them, the rows that would not be done when it ends are
// left out, with what those that are open still take.
static bool is_late(const struct measuring *m, const struct group *group)
{
    const double left_ms = rg_jobs_expected_ms(m->batch.jobs + group->first_job,
                                               m->batch.job_count - group->first_job, &m->options);
    return m->result->budget_end_ms > 0 && rg_now_ms() + left_ms >= m->result->budget_end_ms;
}

static void leave_out(struct measuring *m, int row)
{
    struct rg_result *result = m->result;
    for (; row <= result->last_row; row++) {
        for (int part = 0; part < RG_BAR_PARTS && rg_result_wants(result, row); part++) {
            const int64_t units = rg_table_row_units(result, &m->bar, row, (enum rg_bar_part)part);
            rg_progress_grow(m->bar.progress,
                             -rg_table_bar_begin(&m->bar, (enum rg_bar_part)part, units));
        }
        result->left_out[row - result->first_row] = true;
    }
}

// Whether each device holds the buffers and images of so many rows.
static bool have_room(const struct measuring *m, int rows)
{
    bool room = true;
    for (int d = 0; d < m->result->device_count; d++) {
        const int instances = rows * rg_result_row_cells(m->result) / m->result->device_count;
        const int most = m->result->devices[d].limits.max_objects;
        room = room && (int64_t)instances * OBJECTS_AN_INSTANCE <= most;
    }
    return room;
}

// Whether one row more can be open, as large as those that are: half of the memory is theirs.
static bool has_room(const struct measuring *m, int rows)
{
    const int64_t taken = m->available - rg_memory_available();
    if (m->table->rows_at_once && rows == m->table->rows_at_once)
        return false;
    return m->available > 0 && taken + taken / rows <= rg_memory_left() / 2 &&
           have_room(m, rows + 1);
}

// Opens rows from `row` on, as many as memory holds, and returns the one that comes next. `*ok`:
// there was memory for their records.
static int open_group(struct measuring *m, struct group *group, int row, bool *ok)
{
    struct rg_result *result = m->result;
    int rows = 0;
    *group = (struct group){.first_row = row, .first_job = m->batch.job_count, .last_row = row - 1};
    m->available = rg_memory_available();
    for (; *ok && row <= result->last_row && !rg_interrupted(); row++) {
        if (rows && !has_room(m, rows))
            break;
        if (rg_result_wants(result, row) && is_late(m, group))
            leave_out(m, row);
        if (!rg_result_wants(result, row))
            continue;
        *ok = rg_table_add_row(result, m->table, row);
        if (*ok && !take_row(m, row)) {
            prepare(m, row);
            rows++;
        }
        group->last_row = row;
    }
    // A texture's row has nothing that tells whether it is whole.
    if (rg_interrupted() && result->is_of_textures && group->last_row >= group->first_row)
        rg_result_drop_row(result, group->last_row);
    group->job_count = m->batch.job_count - group->first_job;
    return row;
}

// --- groups are visited ---

static void close_jobs(struct measuring *m, const struct group *group)
{
    for (int i = group->first_job; i < group->first_job + group->job_count; i++) {
        struct rg_job *job = &m->batch.jobs[i];
        if (job->session)
            rg_kept_put(m->kept, job->session);
        job->session = NULL;
    }
}

// Once its jobs are open it is known what its samples take.
static void expect_samples(struct measuring *m, struct group *group, int visits)
{
    const double unit_ms = rg_progress_unit_ms(m->bar.progress, rg_now_ms());
    const double ms = samples_ms(m, m->batch.jobs + group->first_job, group->job_count, visits);
    int64_t planned = 0;
    for (int row = group->first_row; row <= group->last_row; row++)
        if (rg_result_wants(m->result, row) && !rg_journal_has(m->journal, row))
            planned += rg_table_row_units(m->result, &m->bar, row, RG_BAR_SAMPLING);
    const int64_t shown = rg_table_bar_begin(&m->bar, RG_BAR_SAMPLING, planned);
    group->units = unit_ms > 0 ? (int64_t)(ms / unit_ms) : shown;
    rg_progress_grow(m->bar.progress, group->units - shown);
}

// Takes the samples of a group up to a visit's share of all.
static void visit(struct measuring *m, struct group *group, int visits, int number)
{
    m->now = group;
    m->units = 0;
    m->share = 1.0 / visits;
    m->options.share = (double)(number + 1) / visits;
    rg_progress_label(m->bar.progress, "%s, rows %d-%d in turn%s", m->table->id,
                      group->first_row + 1, group->last_row + 1, number ? ", again" : "");
    if (!rg_interrupted() && group->job_count)
        rg_jobs_measure(m->batch.jobs + group->first_job, group->job_count, &m->options);
    show_share(1, m);
    keep(m);
    close_jobs(m, group);
}

// The first visit to each group opens it; where all rows are in one, no other follows.
static bool visit_all(struct measuring *m)
{
    const int last = m->result->last_row;
    int row = m->result->first_row, visits = 1;
    bool ok = true;
    while (ok && row <= last && !rg_interrupted()) {
        struct group *group = &m->groups[m->group_count++];
        row = open_group(m, group, row, &ok);
        visits = m->group_count > 1 || row <= last ? VISITS : 1;
        expect_samples(m, group, visits);
        visit(m, group, visits, 0);
    }
    for (int number = 1; ok && number < visits; number++)
        for (int g = 0; g < m->group_count && !rg_interrupted(); g++)
            visit(m, &m->groups[g], visits, number);
    return ok;
}

static bool measure(struct measuring *m)
{
    const struct rg_result *result = m->result;
    const bool ok = rg_batch_open(&m->batch, result->last_row - result->first_row + 1);
    const bool done = ok && visit_all(m);
    rg_batch_close(&m->batch);
    if (rg_interrupted())
        rg_result_drop_begun(m->result);
    return done;
}

bool rg_table_measure(struct rg_result *result, const struct rg_table *table, struct rg_kept *kept,
                      struct rg_journal *journal, const struct rg_table_bar *bar)
{
    struct rg_progress own;
    struct rg_table_learned learned = {0};
    struct measuring m = {
        .result = result,
        .table = table,
        .kept = kept,
        .journal = journal,
        .bar = bar ? *bar : rg_table_bar_of(NULL, &own, &learned),
        .options = *(result->few_samples ? rg_table_few_samples() : rg_table_options(result->full)),
        .batch = {.result = result, .table = table, .kept = kept},
        .kept_ms = rg_now_ms()};
    m.options.progress = show_share;
    m.options.user = &m;
    if (!bar)
        rg_progress_start(&own, rg_table_bar_add(&m.bar, result, journal));
    const bool ok = measure(&m);
    if (!bar)
        rg_progress_end(&own);
    return ok;
}
