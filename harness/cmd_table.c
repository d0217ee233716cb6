// raingauge table: regenerates the papers' tables.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/log.h"
#include "harness/output.h"
#include "harness/table.h"

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
    struct rg_grid grid;
    rg_table_grid(run, &grid);
    if (!strcmp(format, "csv"))
        rg_grid_print_csv(&grid, out);
    else if (!strcmp(format, "tex"))
        rg_grid_print_tex(&grid, out);
    else
        rg_grid_print_md(&grid, out);
    rg_grid_free(&grid);
    return !grid.incomplete;
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
    static const char *const formats[] = {"md", "csv", "json", "tex"};
    bool ok = true;
    for (int i = 0; ok && i < 4; i++)
        ok = write_as(run, formats[i], folder);
    return ok;
}

// Pass when every cell was measured, fail when one disagreed, nothing when none was measured.
static int judge(const struct rg_table_run *run)
{
    int ok = 0, failed = 0;
    for (int i = 0; i < run->cell_count; i++) {
        ok += run->cells[i].status == RG_CELL_OK;
        failed += run->cells[i].status == RG_CELL_FAIL || run->cells[i].status == RG_CELL_ERROR;
    }
    return failed ? RG_EXIT_FAIL : ok ? RG_EXIT_PASS : RG_EXIT_NOTHING;
}

static int run_table(const struct rg_table *table, const struct rg_devices *devices,
                     const struct rg_options *o)
{
    struct rg_table_run run = {.table = table,
                               .devices = devices,
                               .first_row = o->first_row ? o->first_row - 1 : 0,
                               .last_row = table->row_count - 1,
                               .full = o->full};
    if (o->last_row && o->last_row < table->row_count)
        run.last_row = o->last_row - 1;
    int exit = RG_EXIT_FAIL;
    if (rg_table_measure(&run)) {
        exit = judge(&run);
        if (!print_as(&run, o->json ? "json" : o->format ? o->format : "md", stdout))
            exit = RG_EXIT_FAIL;
        fflush(stdout);
        if (o->output && !write_all(&run, o->output))
            exit = RG_EXIT_USAGE;
    }
    rg_table_run_free(&run);
    return exit;
}

// The tables that are named, or all. False, and one logged line, where one is unknown.
static bool choose(const struct rg_options *o, const struct rg_table *chosen[], int *count)
{
    *count = 0;
    for (int i = 0; i < o->arg_count; i++) {
        chosen[(*count)++] = rg_table_find(o->args[i]);
        if (!chosen[i])
            return rg_error("table '%s': unknown; `raingauge list tables` prints them", o->args[i]);
    }
    for (int i = 0; rg_tables[i] && !o->arg_count && i < RG_MAX_ARGS; i++)
        chosen[(*count)++] = rg_tables[i];
    return true;
}

// Whether a table has all the rows that are asked for; the others then give those that they have.
static bool have_rows(const struct rg_options *o, const struct rg_table *const chosen[], int count)
{
    const struct rg_table *longest = chosen[0];
    for (int i = 1; i < count; i++)
        longest = chosen[i]->row_count > longest->row_count ? chosen[i] : longest;
    if (o->last_row <= longest->row_count)
        return true;
    return rg_error("--rows %d-%d: %s has rows 1-%d", o->first_row, o->last_row, longest->id,
                    longest->row_count);
}

// Bad input outweighs a failure, and a failure nothing measured.
static int worse(int a, int b)
{
    static const int order[] = {RG_EXIT_USAGE, RG_EXIT_FAIL, RG_EXIT_NOTHING};
    for (int i = 0; i < 3; i++)
        if (a == order[i] || b == order[i])
            return order[i];
    return RG_EXIT_PASS;
}

static int table(const struct rg_options *o)
{
    const struct rg_table *chosen[RG_MAX_ARGS];
    int count;
    if (!choose(o, chosen, &count) || !have_rows(o, chosen, count))
        return RG_EXIT_USAGE;
    struct rg_devices devices;
    int exit = rg_devices_open(o, "all", &devices);
    // A table that fails keeps none of the others from being measured and written.
    const bool opened = exit == RG_EXIT_PASS;
    int printed = 0;
    for (int i = 0; opened && i < count; i++) {
        if (o->first_row > chosen[i]->row_count)
            continue;
        if (printed++)
            printf("\n");
        exit = worse(exit, run_table(chosen[i], &devices, o));
    }
    if (exit == RG_EXIT_PASS && devices.broken_count)
        exit = RG_EXIT_FAIL;
    rg_devices_close(&devices);
    return exit;
}

const struct rg_command rg_command_table = {
    .name = "table",
    .usage = "[ID...] [--device D,...|all] [--quick|--full] [--rows A-B] [--format F] [-o DIR]",
    .about = "regenerates the papers' tables: published beside measured, on every device",
    .options =
        RG_OPT_DEVICE | RG_OPT_LENGTH | RG_OPT_ROWS | RG_OPT_FORMAT | RG_OPT_OUTPUT | RG_OPT_JSON,
    .run = table,
};
