#include "harness/tables/runs/regenerate.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/others.h"
#include "harness/judge/settle.h"
#include "harness/record/disk/hold.h"
#include "harness/tables/launching/launches.h"
#include "harness/tables/runs/budget.h"
#include "harness/tables/runs/closing.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/measuring/measure.h"

// One table of the command.
struct task {
    const struct rg_table *table;
    struct rg_result result;
    struct rg_journal *journal;
    bool is_measured;
    bool has_failed;  // a launch did
    bool is_lost;     // its files or its printed text could not be written
    bool is_not_over; // a budget ended its launches, so that its journal stays
};

static void tell_resumed(const struct task *task)
{
    const struct rg_result *result = &task->result;
    int rows = 0, parts = 0, wanted = 0;
    for (int row = result->first_row; row <= result->last_row; row++) {
        wanted += rg_result_wants(result, row);
        rows += rg_journal_has(task->journal, row);
        parts += rg_journal_has_part(task->journal, row);
    }
    if (rows || parts)
        rg_info("%s: %d of %d rows are those of a run that was interrupted, and %d have some of "
                "their samples; --fresh measures them anew",
                result->table, rows, wanted, parts);
}

static void tell_interrupted(const struct task *task)
{
    const int missing = rg_result_first_missing(&task->result);
    const char *path = rg_journal_path(task->journal), *id = task->result.table;
    if (missing > task->result.last_row)
        rg_info("%s: done, and then interrupted; the same command goes on with the next table", id);
    else if (path)
        rg_info("%s: interrupted; the same command goes on with row %d and what it has of others "
                "(%s)",
                id, missing + 1, path);
    else
        rg_info("%s: interrupted before a row of it was done; the same command begins it anew", id);
}

// Takes the launches of a measured table, `most` for each claim. Sessions that were kept for later
// tables close before, for launches open their own. Returns an enum rg_exit.
static int take_launches(struct task *task, struct rg_kept *kept, struct rg_progress *bar,
                         const struct rg_regenerate_options *options, int most)
{
    const double end_ms = options->budget_s > 0 ? options->begin_ms + 1000 * options->budget_s : 0;
    struct rg_launches_wanted wanted = {options->decides ? rg_claims : NULL, most,
                                        options->launches};
    if ((!options->decides && !options->launches) || task->result.is_of_textures ||
        rg_interrupted())
        return RG_EXIT_PASS;
    const bool clean = rg_kept_free(kept);
    const bool ok =
        rg_launches_take(&task->result, task->table, &wanted, task->journal, bar, end_ms);
    task->has_failed = !ok;
    wanted.most = 0;
    task->is_not_over = options->decides && rg_launches_are_due(&task->result, &wanted);
    if (task->is_not_over)
        rg_journal_keep(task->journal);
    return ok && clean ? RG_EXIT_PASS : RG_EXIT_FAIL;
}

static bool measure_task(struct task *task, struct rg_kept *kept, struct rg_progress *bar)
{
    tell_resumed(task);
    task->is_measured =
        rg_table_measure(&task->result, task->table, kept, task->journal, bar, NULL);
    return task->is_measured;
}

static int print_task(struct task *task, struct rg_progress *bar,
                      const struct rg_regenerate_options *options, struct rg_closing *closing)
{
    rg_progress_hide(bar);
    rg_closing_add(closing, &task->result);
    int exit = options->print(&task->result, options->user);
    task->is_lost = exit == RG_EXIT_USAGE || exit == RG_EXIT_HARNESS;
    if (task->is_lost)
        rg_journal_keep(task->journal);
    if (rg_interrupted()) {
        tell_interrupted(task);
        exit = RG_EXIT_SIGNALLED + rg_interrupt_signal();
    }
    return exit;
}

// Whether quick mode chooses the rows, because the user named none.
static bool is_short(const struct rg_table *table, const struct rg_regenerate_options *o)
{
    return !o->full && !o->last_row && table->quick_rows && !o->decides;
}

// The requested rows, as far as the table has them.
static struct rg_table_part part_of(const struct rg_table *table,
                                    const struct rg_regenerate_options *o)
{
    bool chosen[RG_TABLE_ROWS];
    int rows = table->row_count;
    for (rg_quick_rows(table, chosen); is_short(table, o) && !chosen[rows - 1]; rows--)
        ;
    return (struct rg_table_part){.first_row = o->first_row ? o->first_row - 1 : 0,
                                  .last_row =
                                      (o->last_row && o->last_row < rows ? o->last_row : rows) - 1,
                                  .full = o->full,
                                  .work = o->decides && table->works[0].name ? "paper" : o->work,
                                  .variant = o->variant,
                                  .set = o->set};
}

static void leave_out_rows(const struct rg_table *table, struct rg_result *result)
{
    bool chosen[RG_TABLE_ROWS];
    rg_quick_rows(table, chosen);
    for (int row = result->first_row; row <= result->last_row; row++)
        result->left_out[row - result->first_row] = !chosen[row];
}

// Drops from a begun result the parts that no claim needs. It gets few samples, since launches
// decide. False, and the result is freed, if there is no claim.
static bool choose_launches(struct rg_result *result, const struct rg_table *table)
{
    result->few_samples = true;
    if (rg_launches_choose(result, table))
        return true;
    rg_result_free(result);
    return false;
}

// Begins the tables that have some of the requested rows. Reads all journals before it writes one,
// since a table may be named twice. `keeps`: journals are kept.
static int make_tasks(const struct rg_regenerate_options *o, const struct rg_devices *devices,
                      const struct rg_table *const tables[], int count, bool keeps,
                      struct task *tasks)
{
    int made = 0;
    for (int i = 0; i < count; i++) {
        const struct rg_table_part part = part_of(tables[i], o);
        if (part.first_row > part.last_row)
            continue;
        tasks[made].table = tables[i];
        rg_table_begin(&tasks[made].result, tables[i], &part, devices);
        if (is_short(tables[i], o))
            leave_out_rows(tables[i], &tasks[made].result);
        if (o->decides && !choose_launches(&tasks[made].result, tables[i]))
            continue;
        made++;
    }
    for (int i = 0; keeps && i < made; i++)
        tasks[i].journal = rg_journal_open(&tasks[i].result, o->folder, o->fresh, i < made - 1);
    return made;
}

// Keeps a journal of an earlier run from being replaced after a driver crashed while its device was
// opened. The journal may include that device, and the same command can go on from it once the
// driver works. False, with one logged line, if one would be replaced.
static bool spare_journals(const struct task *tasks, int count, const struct rg_devices *devices)
{
    for (int i = 0; i < count && rg_devices_exit(devices) != RG_EXIT_PASS; i++)
        if (rg_journal_is_of_others(tasks[i].journal))
            return rg_driver_error(
                "%s: a driver fell while its device was opened, so that what a run "
                "before has measured would be replaced; go on once it is well, name "
                "the devices that are with --device, or begin anew with --fresh",
                tasks[i].result.table);
    return true;
}

static int64_t units_of(const struct task *tasks, int count)
{
    int64_t units = 0;
    for (int i = 0; i < count; i++)
        units += rg_table_units(&tasks[i].result, tasks[i].journal);
    return units;
}

// Whether journals have to stay. They go only once all tables are written and printed; otherwise
// the same command goes on from them.
static bool keeps_journals(const struct task *tasks, int count)
{
    bool any_is_lost = false, has_file = false;
    for (int i = 0; i < count; i++) {
        any_is_lost = any_is_lost || tasks[i].is_lost;
        has_file = has_file || rg_journal_path(tasks[i].journal);
    }
    if (any_is_lost && has_file && !rg_interrupted())
        rg_info("once all can be written, the same command goes on with what was measured");
    return any_is_lost || rg_interrupted();
}

static int print_end(const struct rg_regenerate_options *options)
{
    return options->print_end ? options->print_end(options->user) : RG_EXIT_PASS;
}

// The text after the tables belongs to all of them, so if it cannot be written, every table keeps
// its journal.
static int finish_tasks(struct task *tasks, int count, const struct rg_regenerate_options *options)
{
    const int exit = print_end(options);
    for (int i = 0; (exit == RG_EXIT_USAGE || exit == RG_EXIT_HARNESS) && i < count; i++) {
        tasks[i].is_lost = true;
        rg_journal_keep(tasks[i].journal);
    }
    return exit;
}

static void forget_tasks(struct task *tasks, int count)
{
    for (int i = 0; i < count; i++) {
        rg_result_free(&tasks[i].result);
        rg_journal_close(tasks[i].journal);
    }
}

// Ends the command. If journals stay, another line has said so already.
static void end_tasks(struct task *tasks, int count, const struct rg_closing *closing, int devices)
{
    const bool are_kept = keeps_journals(tasks, count);
    if (!are_kept)
        rg_closing_tell(closing, devices);
    for (int i = 0; i < count && !are_kept; i++) {
        if (tasks[i].is_not_over && rg_journal_path(tasks[i].journal))
            rg_info("%s: claims are open; the same command goes on (%s)", tasks[i].result.table,
                    rg_journal_path(tasks[i].journal));
        if (!tasks[i].is_not_over)
            rg_journal_remove(tasks[i].journal);
    }
    forget_tasks(tasks, count);
}

// A failed table does not keep the others from being measured and written.
static int run_task(struct task *task, struct rg_kept *kept, struct rg_progress *bar,
                    const struct rg_regenerate_options *o, struct rg_closing *closing)
{
    if (!measure_task(task, kept, bar))
        return rg_exit_of_error();
    const int launched = take_launches(task, kept, bar, o, 0);
    return rg_exit_worse(print_task(task, bar, o, closing), launched);
}

// Decides the claims of all tables. Launches for a look, and to confirm it, are taken of every
// table before those for the next look, so that a claim that is hard to decide does not use up a
// budget.
static int decide_tasks(struct task *tasks, int count, struct rg_kept *kept,
                        struct rg_progress *bar, const struct rg_regenerate_options *o,
                        struct rg_closing *closing)
{
    const int last = rg_settle_rule.look_count - 1;
    int exit = RG_EXIT_PASS;
    rg_progress_unlike(bar, count > 1);
    for (int look = 0; look <= last; look++)
        for (int i = 0; i < count && !rg_interrupted(); i++) {
            const int most = look < last ? 2 * rg_settle_rule.looks[look] : 0;
            if (!look && !measure_task(&tasks[i], kept, bar))
                exit = rg_exit_worse(exit, rg_exit_of_error());
            if (tasks[i].is_measured && !tasks[i].has_failed)
                exit = rg_exit_worse(exit, take_launches(&tasks[i], kept, bar, o, most));
        }
    for (int i = 0; i < count; i++)
        if (tasks[i].is_measured)
            exit = rg_exit_worse(exit, print_task(&tasks[i], bar, o, closing));
    return exit;
}

static int run_tasks(struct task *tasks, int count, const struct rg_devices *devices,
                     const struct rg_regenerate_options *o)
{
    struct rg_kept kept = {.devices = devices};
    struct rg_progress progress;
    struct rg_closing closing = {0};
    int exit = RG_EXIT_PASS;
    rg_interrupt_watch();
    rg_progress_start(&progress, units_of(tasks, count));
    if (o->decides)
        exit = decide_tasks(tasks, count, &kept, &progress, o, &closing);
    for (int i = 0; !o->decides && i < count && !rg_interrupted(); i++) {
        rg_progress_unlike(&progress, i + 1 < count); // the next may take a hundred times as long
        exit = rg_exit_worse(exit, run_task(&tasks[i], &kept, &progress, o, &closing));
    }
    rg_progress_end(&progress);
    if (rg_interrupted())
        exit = rg_exit_worse(exit, RG_EXIT_SIGNALLED + rg_interrupt_signal());
    exit = rg_exit_with(rg_exit_worse(exit, finish_tasks(tasks, count, o)),
                        rg_closing_measured(&closing));
    end_tasks(tasks, count, &closing, devices->count);
    return rg_kept_free(&kept) ? exit : rg_exit_worse(exit, RG_EXIT_FAIL);
}

static int regenerate(const struct rg_table *const tables[], int count,
                      const struct rg_devices *devices, const struct rg_regenerate_options *options,
                      bool keeps)
{
    if (options->budget_s > 0 && !options->decides)
        return rg_tables_within(tables, count, devices, options, stderr);
    struct task *tasks = rg_alloc((size_t)count, sizeof(*tasks), "tables");
    const int made = tasks ? make_tasks(options, devices, tables, count, keeps, tasks) : 0;
    const bool ok = tasks && spare_journals(tasks, made, devices);
    const int exit = ok ? run_tasks(tasks, made, devices, options) : rg_exit_of_error();
    if (!ok)
        forget_tasks(tasks, made);
    free(tasks);
    return exit;
}

int rg_tables_regenerate(const struct rg_table *const tables[], int count,
                         const struct rg_devices *devices,
                         const struct rg_regenerate_options *options)
{
    char state[1536] = "";
    struct rg_hold hold = {.fd = -1};
    if (!options->folder)
        rg_state_folder(state, sizeof(state));
    const char *folder = options->folder ? options->folder : state;
    const bool is_ours = !*folder || rg_hold_folder(folder, &hold);
    if (!is_ours && options->folder) {
        rg_error("%s: another raingauge measures into it; wait until it has ended, or name another "
                 "folder",
                 folder);
        return rg_exit_of_error();
    }
    if (!is_ours)
        rg_warning("%s: another raingauge that measures keeps its rows there; this one keeps none: "
                   "write into a folder with -o to go on after an interruption",
                   folder);
    rg_machine_probe(rg_processors_now);
    const int exit = regenerate(tables, count, devices, options, is_ours);
    rg_hold_release(&hold);
    return exit;
}
