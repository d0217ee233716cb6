#include "harness/tables/print.h"

#include <stdlib.h>
#include <unistd.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/disk/cells.h"
#include "harness/record/disk/journal.h"
#include "harness/record/output.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/sheet/brief.h"
#include "harness/tables/sheet/sheet.h"
#include "harness/tables/sheet/trend.h"

const char *const rg_result_formats[] = {[RG_RESULT_MD] = "md",
                                         [RG_RESULT_CSV] = "csv",
                                         [RG_RESULT_JSON] = "json",
                                         [RG_RESULT_TEX] = "tex",
                                         NULL};

// Prints a result's document, with the trends, which are computed from it and never read back.
static bool print_json(const struct rg_result *result, FILE *out)
{
    json_t *json = rg_result_json(result);
    const bool ok = rg_cells_seal(json) || rg_harness_error("table '%s': no memory", result->table);
    json_object_set_new(json, "shapes", rg_trends_json(result));
    if (ok) {
        json_dumpf(json, out, JSON_INDENT(1) | RG_JSON_FLAGS);
        fprintf(out, "\n");
    }
    json_decref(json);
    return ok;
}

bool rg_result_print(const struct rg_result *result, int format, FILE *out)
{
    if (format == RG_RESULT_JSON)
        return print_json(result, out);
    if (format == RG_RESULT_MD)
        return rg_brief_print(result, out);
    if (format == RG_RESULT_TEX)
        return rg_brief_print_tex(result, out);
    struct rg_sheet sheet;
    rg_result_sheet(result, &sheet);
    if (format == RG_RESULT_CSV)
        rg_sheet_print_csv(&sheet, out);
    else
        rg_sheet_print_md(&sheet, out);
    rg_sheet_free(&sheet);
    return !sheet.incomplete;
}

// Prints the result in a format to memory that the caller frees; NULL with one logged line.
static char *print_text(const struct rg_result *result, int format)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    bool ok = out && rg_result_print(result, format, out);
    if (!out || fclose(out))
        ok = rg_harness_error("table '%s': no memory to print it", result->table);
    if (!ok)
        free(text);
    return ok ? text : NULL;
}

enum { FILE_NAME_SIZE = RG_NAME_SIZE + 8 };

static void name_file(const char *table, int format, char name[FILE_NAME_SIZE])
{
    snprintf(name, FILE_NAME_SIZE, "%s.%s", table, rg_result_formats[format]);
}

bool rg_results_can_be_written(const struct rg_table *const tables[], int count, const char *folder)
{
    char name[FILE_NAME_SIZE];
    bool ok = rg_output_can_be_written(folder, (int64_t)count * RG_OUTPUT_TABLE_BYTES);
    for (int i = 0; i < count; i++)
        for (int format = 0; ok && rg_result_formats[format]; format++) {
            name_file(tables[i]->id, format, name);
            ok = rg_output_can_be_replaced(folder, name);
        }
    return ok;
}

static bool spares(const char *folder, const char *name, const char *read)
{
    char path[2048]; // a path that does not fit is refused when it is written
    return snprintf(path, sizeof(path), "%s/%s", folder, name) >= (int)sizeof(path) ||
           rg_file_spares(path, read);
}

bool rg_result_spares(const struct rg_table *table, const char *folder, const char *read)
{
    char name[RG_JOURNAL_NAME_SIZE];
    bool spared = true;
    for (int format = 0; spared && rg_result_formats[format]; format++) {
        name_file(table->id, format, name);
        spared = spares(folder, name, read);
    }
    for (int full = 0; spared && full < 2; full++) {
        rg_journal_name(table->id, full, name);
        spared = spares(folder, name, read);
    }
    return spared;
}

static bool has_number(const struct rg_result *result)
{
    bool any = false;
    for (struct rg_place at = rg_result_start(result); !any && rg_result_next(result, &at);)
        any = rg_result_at(result, at)->outcome == RG_OK;
    return any;
}

// Keeps an earlier result if nothing was measured now.
static bool keeps_what_is_there(const struct rg_result *result, const char *folder)
{
    char name[FILE_NAME_SIZE], path[2048];
    name_file(result->table, RG_RESULT_JSON, name);
    if (has_number(result) ||
        snprintf(path, sizeof(path), "%s/%s", folder, name) >= (int)sizeof(path) ||
        access(path, F_OK))
        return false;
    rg_warning("%s: is kept, for no cell of %s was measured now", path, result->table);
    return true;
}

bool rg_result_write(const struct rg_result *result, const char *folder)
{
    if (keeps_what_is_there(result, folder))
        return true;
    struct rg_output_file files[RG_MAX_OUTPUT_FILES];
    char *texts[RG_MAX_OUTPUT_FILES], names[RG_MAX_OUTPUT_FILES][FILE_NAME_SIZE];
    int count = 0;
    bool ok = true;
    for (; ok && rg_result_formats[count]; count++) {
        texts[count] = print_text(result, count);
        name_file(result->table, count, names[count]);
        files[count] = (struct rg_output_file){.name = names[count], .text = texts[count]};
        ok = texts[count];
    }
    ok = ok && rg_output_write_set(folder, files, count);
    for (int i = 0; i < count; i++)
        free(texts[i]);
    return ok;
}

int rg_result_exit(const struct rg_result *result)
{
    int counts[RG_OUTCOME_COUNT] = {0};
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        counts[record->outcome]++;
        if (rg_outcome_is_broken(record->truth_error.outcome))
            counts[record->truth_error.outcome]++;
    }
    return rg_exit_of_all(counts);
}

// Whether all output arrived. False, and one line logged only once for all tables.
static bool is_printed(bool was_lost)
{
    return (!fflush(stdout) && !ferror(stdout)) || (!was_lost && rg_stdout_error());
}

int rg_result_finish(const struct rg_result *result, int format, const char *folder)
{
    struct rg_place at = rg_result_start(result);
    int exit = rg_result_exit(result);
    const bool is_whole = rg_result_first_missing(result) > result->last_row;
    const bool was_lost = ferror(stdout);
    // The file is written before printing, since SIGPIPE ends raingauge when nobody reads stdout.
    if (is_whole && folder && !rg_result_write(result, folder))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    if (rg_result_next(result, &at) && !rg_result_print(result, format, stdout))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    return is_printed(was_lost) ? exit : rg_exit_worse(exit, RG_EXIT_HARNESS);
}
