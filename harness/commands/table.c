// raingauge table: regenerates the papers' tables.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/cli/command.h"
#include "harness/cli/shared.h"
#include "harness/console/interrupt.h"
#include "harness/record/journal.h"
#include "harness/record/output.h"
#include "harness/tables/table.h"

struct table_options {
    struct rg_rows rows;
    struct rg_length length;
    char *devices, *output; // names; a folder
    int format;             // of `formats`
    bool fresh, json;
};

#define AT(field) offsetof(struct table_options, field)

static const char *const formats[] = {"md", "csv", "json", "tex", NULL};

static const struct rg_option options[] = {
    RG_GROUP("What to measure"),
    {RG_OPTION_OPERAND, .argument = "ID",
     .about = "a table; `raingauge list tables` prints them, and all are meant where none is named",
     .names = RG_NAMES_TABLE, .first = 1},
    {RG_OPTION_ROWS, "rows", .argument = "A-B", .about = "only these rows, counted from 1",
     .offset = AT(rows)},
    RG_INCLUDE(rg_length_options, AT(length), NULL),
    {RG_OPTION_FLAG, "fresh", .about = "takes nothing from a run that was interrupted",
     .offset = AT(fresh)},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices), "all"),
    RG_GROUP("Output"),
    {RG_OPTION_CHOICE, "format", .about = "what to print", .offset = AT(format), .choices = formats,
     .initial = "md"},
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "writes each table into this folder too, in every format", .offset = AT(output),
     .letter = 'o', .names = RG_NAMES_FOLDER},
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static void print_json(const struct rg_table_run *run, FILE *out)
{
    json_t *json = rg_table_json(run);
    json_dumpf(json, out, JSON_INDENT(1) | JSON_REAL_PRECISION(9));
    fprintf(out, "\n");
    json_decref(json);
}

// False, and one logged line, when the table found no memory.
static bool print_as(const struct rg_table_run *run, const char *format, FILE *out)
{
    if (!strcmp(format, "json")) {
        print_json(run, out);
        return true;
    }
    struct rg_sheet sheet;
    rg_table_sheet(run, &sheet);
    if (!strcmp(format, "csv"))
        rg_sheet_print_csv(&sheet, out);
    else if (!strcmp(format, "tex"))
        rg_sheet_print_tex(&sheet, out);
    else
        rg_sheet_print_md(&sheet, out);
    rg_sheet_free(&sheet);
    return !sheet.incomplete;
}

static bool write_as(const struct rg_table_run *run, const char *format, const char *folder)
{
    char *text = NULL, name[64];
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return rg_error("table '%s': no memory to print it", run->table->id);
    bool ok = print_as(run, format, out);
    if (fclose(out))
        ok = rg_error("table '%s': no memory to print it", run->table->id);
    snprintf(name, sizeof(name), "%s.%s", run->table->id, format);
    ok = ok && rg_output_write(folder, name, text);
    free(text);
    return ok;
}

// Writes the table in every format into a folder.
static bool write_all(const struct rg_table_run *run, const char *folder)
{
    bool ok = true;
    for (int i = 0; ok && formats[i]; i++)
        ok = write_as(run, formats[i], folder);
    return ok;
}

// What its cells come to, and what came between them and the truth.
static int judge(const struct rg_table_run *run)
{
    const int devices = run->devices->count;
    int counts[RG_OUTCOME_COUNT] = {0};
    for (int i = 0; i < run->cell_count; i++) {
        counts[run->cells[i].status] += !run->groups[i / devices].is_missing;
        if (rg_exit_of(run->groups[i / devices].error_status) == RG_EXIT_FAIL)
            counts[RG_FAIL]++;
    }
    return rg_exit_of_all(counts);
}

// One table of the command.
struct job {
    struct rg_table_run run;
    struct rg_journal *journal;
};

static void tell_resumed(const struct job *job)
{
    const struct rg_table_run *run = &job->run;
    int rows = 0;
    for (int row = run->first_row; row <= run->last_row; row++)
        rows += rg_journal_has(job->journal, row);
    if (rows)
        rg_info("%s: %d of %d rows are those of a run that was interrupted; --fresh measures them "
                "anew",
                run->table->id, rows, run->last_row - run->first_row + 1);
}

static void tell_interrupted(const struct job *job)
{
    const int missing = rg_table_first_missing(&job->run);
    const char *path = rg_journal_path(job->journal), *id = job->run.table->id;
    if (missing > job->run.last_row)
        rg_info("%s: done, and then interrupted; the same command goes on with the next table", id);
    else if (path)
        rg_info("%s: interrupted; the same command goes on with row %d (%s)", id, missing + 1,
                path);
    else
        rg_info("%s: interrupted before a row of it was done; the same command begins it anew", id);
}

static int run_job(struct job *job, struct rg_kept *kept, const struct table_options *o)
{
    struct rg_table_run *run = &job->run;
    tell_resumed(job);
    if (!rg_table_measure(run, kept, job->journal))
        return RG_EXIT_FAIL;
    int exit = judge(run);
    const bool is_whole = rg_table_first_missing(run) > run->last_row;
    const bool has_rows = rg_table_first_missing(run) > run->first_row;
    if (has_rows && !print_as(run, o->json ? "json" : formats[o->format], stdout))
        exit = RG_EXIT_FAIL;
    fflush(stdout);
    if (is_whole && o->output && !write_all(run, o->output))
        exit = rg_exit_worse(exit, RG_EXIT_USAGE);
    if (rg_interrupted()) {
        tell_interrupted(job);
        exit = RG_EXIT_SIGNALLED + rg_interrupt_signal();
    }
    return exit;
}

// The tables that are named, or all. False, and one logged line, where one is unknown.
static bool choose(const struct rg_words *ids, const struct rg_table *chosen[], int *count)
{
    *count = 0;
    for (int i = 0; i < ids->count; i++) {
        chosen[(*count)++] = rg_table_find(ids->items[i]);
        if (!chosen[i])
            return rg_error("table '%s': unknown; `raingauge list tables` prints them",
                            ids->items[i]);
    }
    for (int i = 0; rg_tables[i] && !ids->count && i < RG_MAX_WORDS; i++)
        chosen[(*count)++] = rg_tables[i];
    return true;
}

// Whether a table has all the rows that are asked for; the others then give those that they have.
static bool have_rows(struct rg_rows rows, const struct rg_table *const chosen[], int count)
{
    const struct rg_table *longest = chosen[0];
    for (int i = 1; i < count; i++)
        longest = chosen[i]->row_count > longest->row_count ? chosen[i] : longest;
    if (rows.last <= longest->row_count)
        return true;
    return rg_error("--rows %d-%d: %s has rows 1-%d", rows.first, rows.last, longest->id,
                    longest->row_count);
}

// The tables that have some of the rows. Journals are read before one is written: a table may be
// named twice.
static int make_jobs(const struct table_options *o, const struct rg_devices *devices,
                     const struct rg_table *const chosen[], int count, struct job *jobs)
{
    int made = 0;
    for (int i = 0; i < count; i++) {
        const int last = o->rows.last && o->rows.last < chosen[i]->row_count ? o->rows.last
                                                                             : chosen[i]->row_count;
        if (o->rows.first > last)
            continue;
        jobs[made++].run = (struct rg_table_run){.table = chosen[i],
                                                 .devices = devices,
                                                 .first_row = o->rows.first ? o->rows.first - 1 : 0,
                                                 .last_row = last - 1,
                                                 .full = o->length.full};
    }
    for (int i = 0; i < made; i++)
        jobs[i].journal = rg_journal_open(&jobs[i].run, o->output, o->fresh, i < made - 1);
    return made;
}

// A table that fails keeps none of the others from being measured and written.
static int run_jobs(struct job *jobs, int count, const struct rg_devices *devices,
                    const struct table_options *o)
{
    struct rg_kept kept = {.devices = devices};
    int exit = RG_EXIT_PASS;
    rg_interrupt_watch();
    for (int i = 0; i < count && !rg_interrupted(); i++) {
        if (i)
            printf("\n");
        exit = rg_exit_worse(exit, run_job(&jobs[i], &kept, o));
    }
    for (int i = 0; i < count; i++) {
        if (!rg_interrupted())
            rg_journal_remove(jobs[i].journal);
        rg_table_run_free(&jobs[i].run);
        rg_journal_close(jobs[i].journal);
    }
    return rg_kept_free(&kept) ? exit : rg_exit_worse(exit, RG_EXIT_FAIL);
}

static int table(const void *values, const struct rg_words *arguments)
{
    const struct table_options *o = values;
    const struct rg_table *chosen[RG_MAX_WORDS];
    int count;
    if (!choose(arguments, chosen, &count) || !have_rows(o->rows, chosen, count))
        return RG_EXIT_USAGE;
    struct rg_devices devices;
    int exit = rg_devices_open(o->devices, &devices);
    if (exit != RG_EXIT_PASS)
        return exit;
    struct job *jobs = rg_alloc((size_t)count, sizeof(*jobs), "tables");
    exit = jobs ? run_jobs(jobs, make_jobs(o, &devices, chosen, count, jobs), &devices, o)
                : RG_EXIT_FAIL;
    free(jobs);
    if (devices.broken_count)
        exit = rg_exit_worse(exit, RG_EXIT_FAIL);
    rg_devices_close(&devices);
    return exit;
}

const struct rg_command rg_command_table = {
    .name = "table",
    .usage = "[ID...] [--device D,...|all] [--quick|--full] [--rows A-B] [--format F] [-o DIR] "
             "[--fresh]",
    .about = "regenerates the papers' tables: published beside measured, on every device",
    .options = options,
    .options_size = sizeof(struct table_options),
    .run = table,
};
