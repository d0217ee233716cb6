// Measures a table's rows. As many rows as fit into memory are open together and timed in turn. If
// not all fit, each group of rows is visited several times: a temporary disturbance of the machine
// then does not hit one row alone.
#include <math.h>

#include "core/base/memory.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/tables/measuring/batch.h"
#include "harness/tables/measuring/measure.h"

// Visits to each group of rows, if there are several groups.
enum { VISITS = 3 };
// Upper limit of the buffers and images of an instance.
enum { OBJECTS_AN_INSTANCE = 100 };
// Units of the progress bar per cell: for opening it, and again for sampling it.
enum { CELL_UNITS = 1000 };
// How often results are saved to disk.
#define KEEP_EVERY_MS 30000

// Rows that are open together, and their jobs in the batch.
struct group {
    int first_row, last_row;
    int first_job, job_count;
    int64_t units; // of the progress bar, for the group's samples
};

struct measuring {
    struct rg_result *result;
    const struct rg_table *table;
    struct rg_kept *kept;
    struct rg_journal *journal;
    struct rg_measure_options options;
    struct rg_progress *bar;
    const struct rg_table_deadline *deadline; // NULL: none
    int rows_opened;
    double least_ms; // shortest opening of a row, without the first
    struct rg_batch batch;
    struct group groups[RG_TABLE_ROWS];
    int group_count;
    struct group *now; // the visited group
    double share;      // part of the group's samples that this visit takes
    // The time at which the first round of this visit was over (0: it is not), and the time that
    // was expected to be left then.
    double first_ms, first_left_ms;
    int64_t units;     // of the bar, for samples of this visit
    double kept_ms;    // time of the last save
    int64_t available; // memory in bytes when the group began
};

// --- saving and reporting ---

static void keep(struct measuring *m)
{
    for (int row = m->now->first_row; row <= m->now->last_row; row++)
        for (struct rg_place at = rg_result_start_row(row);
             rg_result_has(m->result, row) && rg_result_next_in_row(m->result, &at);)
            rg_record_settle(rg_result_at(m->result, at));
    rg_journal_add(m->journal, m->result, m->now->first_row, m->now->last_row);
    m->kept_ms = rg_now_ms();
}

// The time for the remaining samples of all opened jobs, and for opening groups again.
static double samples_left_ms(const struct measuring *m)
{
    double ms = 0;
    for (int i = 0; i < m->batch.job_count; i++) {
        const struct rg_job *job = &m->batch.jobs[i];
        const bool is_whole = rg_record_is_whole(job->record);
        ms += is_whole ? 0 : rg_jobs_expected_ms(job, 1, &m->options);
        if (!is_whole && m->group_count > 1)
            ms += VISITS * (1 - m->options.share) *
                  (job->record->create_ms + job->check_frames * job->warm_frame_ms);
    }
    return ms;
}

// The ratio of the time that samples take to the expected time, since the first round of this
// visit. Frames may take longer than the last one of the warm-up, on a busy machine above all. They
// are not taken to be faster, for the first of a window come before it is opened anew. 0: not known
// yet.
static double pace_of(struct measuring *m, double left_ms)
{
    const double now_ms = rg_now_ms(), done_ms = m->first_left_ms - left_ms;
    if (!(m->first_ms > 0)) {
        m->first_ms = now_ms;
        m->first_left_ms = left_ms;
        return 0;
    }
    return 20 * done_ms > m->first_left_ms ? fmax((now_ms - m->first_ms) / done_ms, 1) : 0;
}

static void show_share(double share, void *user)
{
    struct measuring *m = user;
    const int64_t units = (int64_t)((double)m->now->units * m->share * share);
    const double left_ms = samples_left_ms(m), pace = pace_of(m, left_ms);
    if (pace > 0 && (m->now->last_row == m->result->last_row || m->options.share > m->share))
        rg_progress_due(m->bar, pace * left_ms);
    rg_progress_add(m->bar, units - m->units);
    m->units = units;
    if (share < 1 && rg_now_ms() - m->kept_ms > KEEP_EVERY_MS)
        keep(m);
}

// --- opening rows ---

int64_t rg_table_units(const struct rg_result *result, const struct rg_journal *journal)
{
    int64_t units = 0;
    for (int row = result->first_row; row <= result->last_row; row++)
        if (rg_result_wants(result, row) && !rg_journal_has(journal, row))
            units += 2 * CELL_UNITS * rg_result_row_cells(result);
    return units;
}

// The time for the samples of jobs, and for opening them again in further visits.
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

// --- a deadline ---

// Whether the samples of open rows, and opening and sampling `rows` more, would end after the
// deadline. The first row does not tell how long others take to open, because drivers compile in
// it.
static bool is_late(const struct measuring *m, int rows)
{
    if (!m->deadline || !m->rows_opened)
        return false;
    const double open_ms = rg_jobs_expected_ms(m->batch.jobs, m->batch.job_count, &m->options);
    const double row_ms = m->least_ms + open_ms / m->rows_opened;
    return rg_now_ms() + open_ms + rows * row_ms >= m->deadline->rows_ms;
}

// Drops the jobs from this one on, because their row is dropped.
static void forget_jobs(struct measuring *m, int first_job)
{
    for (; m->batch.job_count > first_job; m->batch.job_count--)
        if (m->batch.jobs[m->batch.job_count - 1].session)
            rg_kept_put(m->kept, m->batch.jobs[m->batch.job_count - 1].session);
}

static void leave_out(struct measuring *m, int row)
{
    struct rg_result *result = m->result;
    for (; row <= result->last_row; row++) {
        if (rg_result_wants(result, row))
            rg_progress_grow(m->bar, -2 * CELL_UNITS * rg_result_row_cells(result));
        result->left_out[row - result->first_row] = true;
    }
}

// --- opening a row ---

// False if the deadline passes between two cells; the row is dropped then.
static bool prepare(struct measuring *m, int row)
{
    const double start_ms = rg_now_ms();
    const int first_job = m->batch.job_count;
    int cells = 0;
    rg_progress_label(m->bar, "%s, row %d", m->table->id, row + 1);
    for (struct rg_place at = rg_result_start_row(row);
         rg_result_next_in_row(m->result, &at) && !rg_interrupted(); cells++) {
        if (at.device == 0 && cells && m->deadline && rg_now_ms() >= m->deadline->end_ms) {
            forget_jobs(m, first_job);
            return false;
        }
        if (at.device == 0 && m->result->is_of_textures)
            rg_batch_tell_texture(&m->batch, at);
        else if (at.device == 0)
            rg_batch_prepare(&m->batch, at, &m->options);
        rg_progress_add(m->bar, CELL_UNITS);
    }
    const double ms = rg_now_ms() - start_ms;
    m->least_ms = m->rows_opened++ < 2 ? (m->rows_opened - 1) * ms : fmin(m->least_ms, ms);
    return true;
}

// Takes over a row from the journal. False if it still has to be measured, wholly or in part.
static bool take_row(struct measuring *m, int row)
{
    if (!rg_journal_take(m->journal, m->result, row))
        return false;
    m->result->resumed_rows++;
    return rg_result_is_whole(m->result, row);
}

// Whether each device's limits allow the buffers and images of so many rows.
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

// Whether memory allows one more row of the size of the open ones; rows may take half of it.
static bool has_room(const struct measuring *m, int rows)
{
    const int64_t taken = m->available - rg_memory_available();
    if (m->table->rows_at_once && rows == m->table->rows_at_once)
        return false;
    return m->available > 0 && taken + taken / rows <= rg_memory_left() / 2 &&
           have_room(m, rows + 1);
}

// The number of rows that have to end before the deadline with this one: all later ones if only
// whole results count, else this one.
static int rows_due(const struct measuring *m, int row)
{
    int rows = 1;
    while (m->deadline && m->deadline->whole && ++row <= m->result->last_row)
        rows += rg_result_wants(m->result, row);
    return rows;
}

// Opens rows from `row` on, as many as memory allows, and returns the next one. *ok becomes false
// without memory for their records.
static int open_group(struct measuring *m, struct group *group, int row, bool *ok)
{
    struct rg_result *result = m->result;
    int rows = 0;
    *group = (struct group){.first_row = row, .first_job = m->batch.job_count, .last_row = row - 1};
    m->available = rg_memory_available();
    for (; *ok && row <= result->last_row && !rg_interrupted(); row++) {
        if (rows && !has_room(m, rows))
            break;
        if (rg_result_wants(result, row) && is_late(m, rows_due(m, row)))
            leave_out(m, row);
        if (!rg_result_wants(result, row))
            continue;
        *ok = rg_table_add_row(result, m->table, row);
        if (*ok && !take_row(m, row)) {
            if (!prepare(m, row)) {
                rg_result_drop_row(result, row);
                leave_out(m, row);
                continue;
            }
            rows++;
        }
        group->last_row = row;
    }
    // A row of textures does not show whether it is complete, so it is dropped.
    if (rg_interrupted() && result->is_of_textures && group->last_row >= group->first_row)
        rg_result_drop_row(result, group->last_row);
    group->job_count = m->batch.job_count - group->first_job;
    return row;
}

// --- visiting groups ---

static void close_jobs(struct measuring *m, const struct group *group)
{
    for (int i = group->first_job; i < group->first_job + group->job_count; i++) {
        struct rg_job *job = &m->batch.jobs[i];
        if (job->session)
            rg_kept_put(m->kept, job->session);
        job->session = NULL;
    }
}

// Adjusts the bar's total, since the open jobs now tell how long their samples take.
static void expect_samples(struct measuring *m, struct group *group, int visits)
{
    const double unit_ms = rg_progress_unit_ms(m->bar, rg_now_ms());
    const double ms = samples_ms(m, m->batch.jobs + group->first_job, group->job_count, visits);
    int64_t planned = 0;
    for (int row = group->first_row; row <= group->last_row; row++)
        if (rg_result_wants(m->result, row) && !rg_journal_has(m->journal, row))
            planned += CELL_UNITS * rg_result_row_cells(m->result);
    group->units = unit_ms > 0 ? (int64_t)(ms / unit_ms) : planned;
    rg_progress_grow(m->bar, group->units - planned);
}

// Takes a group's samples up to this visit's share of all.
static void visit(struct measuring *m, struct group *group, int visits, int number)
{
    m->now = group;
    m->units = 0;
    m->share = 1.0 / visits;
    m->options.share = (double)(number + 1) / visits;
    m->first_ms = 0;
    rg_progress_label(m->bar, "%s, rows %d-%d in turn%s", m->table->id, group->first_row + 1,
                      group->last_row + 1, number ? ", again" : "");
    if (!rg_interrupted() && group->job_count)
        rg_jobs_measure(m->batch.jobs + group->first_job, group->job_count, &m->options);
    show_share(1, m);
    keep(m);
    close_jobs(m, group);
}

// The first visit to each group opens it; if one group has all rows, it is the only visit.
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
                      struct rg_journal *journal, struct rg_progress *bar,
                      const struct rg_table_deadline *deadline)
{
    struct rg_progress own;
    struct measuring m = {
        .result = result,
        .table = table,
        .kept = kept,
        .journal = journal,
        .bar = bar ? bar : &own,
        .deadline = deadline,
        .options = *(result->few_samples ? rg_table_few_samples() : rg_table_options(result->full)),
        .batch = {.result = result, .table = table, .kept = kept},
        .kept_ms = rg_now_ms()};
    m.options.end_ms = deadline ? deadline->rows_ms : 0;
    m.options.progress = show_share;
    m.options.user = &m;
    if (!bar)
        rg_progress_start(&own, rg_table_units(result, journal));
    rg_progress_due(m.bar, -1);
    const bool ok = measure(&m);
    if (!bar)
        rg_progress_end(&own);
    return ok;
}
