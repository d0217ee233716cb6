// Fills in the descriptive part of a table's records, before they are measured.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/measure/expected.h"
#include "harness/devices/measure/sampling.h"
#include "harness/record/passport/passport.h"
#include "harness/tables/table.h"

// --- the head of a result ---

static void name_devices(struct rg_result *result, const struct rg_devices *devices)
{
    result->device_count = devices->count;
    for (int d = 0; d < devices->count; d++)
        result->devices[d] = devices->devices[d]->info;
    result->passport = rg_passport_json(result->devices, result->device_count);
    for (int i = 0; i < devices->absent_count; i++)
        rg_text_copy(result->missing[result->missing_count++], sizeof(result->missing[0]),
                     devices->absent[i].why);
}

static bool any_has_queries(const struct rg_devices *devices)
{
    bool any = false;
    for (int d = 0; d < devices->count; d++)
        any = any || devices->devices[d]->info.limits.has_queries;
    return any;
}

static void copy_or_none(char *to, size_t size, const char *from)
{
    rg_text_copy(to, size, from ? from : "");
}

// Chooses the requested work, or all works that a device of the result can do.
static void name_works(struct rg_result *result, const struct rg_table *table,
                       const struct rg_table_part *part, const struct rg_devices *devices)
{
    const bool is_possible = !part->is_everywhere && any_has_queries(devices);
    for (const struct rg_table_work *work = table->works; work->name; work++) {
        if (part->work ? strcmp(work->name, part->work) != 0 : work->elsewhere && !is_possible)
            continue;
        struct rg_result_work *named = &result->works[result->work_count++];
        rg_text_copy(named->name, sizeof(named->name), work->name);
        rg_text_copy(named->saves, sizeof(named->saves), work->saves);
        copy_or_none(named->reading, sizeof(named->reading), work->reading);
    }
}

void rg_table_begin(struct rg_result *result, const struct rg_table *table,
                    const struct rg_table_part *part, const struct rg_devices *devices)
{
    rg_text_copy(result->table, sizeof(result->table), table->id);
    rg_text_copy(result->technique, sizeof(result->technique), table->technique);
    copy_or_none(result->hardware, sizeof(result->hardware), table->hardware);
    copy_or_none(result->truth, sizeof(result->truth), table->truth);
    copy_or_none(result->quick, sizeof(result->quick), table->quick);
    rg_text_copy(result->note, sizeof(result->note), table->note);
    result->full = part->full;
    result->few_samples = !part->full && rg_sampling_few();
    result->is_of_textures = table->is_of_textures;
    result->width = table->width;
    result->height = table->height;
    result->check_frames = table->check_frames ? table->check_frames : RG_CHECK_FRAMES;
    result->first_row = part->first_row;
    result->last_row = part->last_row;
    copy_or_none(result->changed, sizeof(result->changed), part->set);
    for (const struct rg_table_variant *v = table->variants; v->name; v++)
        if (!part->variant || !strcmp(v->name, part->variant))
            rg_text_copy(result->variants[result->variant_count++], RG_NAME_SIZE, v->name);
    name_works(result, table, part, devices);
    name_devices(result, devices);
}

// --- a row ---

const struct rg_table_work *rg_table_work_at(const struct rg_result *result,
                                             const struct rg_table *table, struct rg_place at)
{
    const struct rg_table_work *work = table->works;
    while (work->name && strcmp(work->name, result->works[at.work].name) != 0)
        work++;
    return work;
}

// The index of a cell's variant in the table; a result may have only some of the variants.
static int variant_at(const struct rg_result *result, const struct rg_table *table,
                      struct rg_place at)
{
    int i = 0;
    while (table->variants[i].name &&
           strcmp(table->variants[i].name, result->variants[at.variant]) != 0)
        i++;
    return i;
}

char *rg_table_assignments(const struct rg_result *result, const struct rg_table *table,
                           struct rg_place at)
{
    const struct rg_table_work *work = rg_table_work_at(result, table, at);
    const char *const parts[] = {
        table->rows[at.row].set, table->variants[variant_at(result, table, at)].set,
        work->name ? work->set : "", result->full || !table->quick ? "" : table->quick,
        result->changed};
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    bool any = false;
    for (int i = 0; out && i < 5; i++) {
        if (!*parts[i])
            continue;
        fprintf(out, "%s%s", any ? " " : "", parts[i]);
        any = true;
    }
    if (out && fclose(out) == 0)
        return text;
    free(text);
    return rg_harness_error_null("table '%s': no memory for a row's settings", table->id);
}

void *rg_table_settings(const struct rg_result *result, const struct rg_table *table,
                        struct rg_place at)
{
    const struct rg_technique *technique = rg_technique_find(table->technique);
    void *defaults = rg_settings_create(technique), *settings = NULL;
    char *assignments = rg_table_assignments(result, table, at);
    if (defaults && assignments)
        settings = rg_settings_copy(technique, defaults, assignments);
    free(assignments);
    free(defaults);
    return settings;
}

// Fills in the row's name, and the settings that are the table's keys.
static void name_row(struct rg_record *record, const struct rg_table *table, int row)
{
    if (table->names)
        rg_named_set_text(&record->row[record->row_count++], table->names, table->rows[row].name);
    for (int c = 0; c < table->key_count; c++) {
        struct rg_named *key = &record->row[record->row_count++];
        char text[RG_FACT_SIZE];
        rg_table_value_text(table, row, c, text, sizeof(text));
        if (rg_table_is_choice(table, c))
            rg_named_set_text(key, table->columns[c], text);
        else
            rg_named_set_number(key, table->columns[c], table->rows[row].values[c]);
    }
}

static void name_published(struct rg_record *record, const struct rg_table *table, int row,
                           int variant)
{
    if (table->variants[variant].fps)
        rg_named_set_number(&record->published[record->published_count++], "fps",
                            rg_table_published_fps(table, row, variant));
    for (int c = 0; table->columns[c]; c++)
        if (rg_table_is_extra(table, c))
            rg_named_set_number(&record->published[record->published_count++], table->columns[c],
                                table->rows[row].values[c]);
}

static bool name_cell(const struct rg_result *result, const struct rg_table *table,
                      struct rg_place at)
{
    struct rg_record *record = rg_result_at(result, at);
    char *assignments = rg_table_assignments(result, table, at);
    if (!assignments)
        return false;
    const bool fits = strlen(assignments) < sizeof(record->set);
    rg_text_copy(record->set, sizeof(record->set), assignments);
    free(assignments);
    if (!fits)
        return rg_error("table '%s': the settings of a row take more than %d bytes; set less",
                        table->id, RG_SET_SIZE - 1);
    memcpy(record->technique, result->technique, sizeof(record->technique));
    memcpy(record->variant, result->variants[at.variant], sizeof(record->variant));
    memcpy(record->work, result->works[at.work].name, sizeof(record->work));
    record->device = result->devices[at.device];
    name_row(record, table, at.row);
    name_published(record, table, at.row, variant_at(result, table, at));
    return true;
}

bool rg_table_add_row(struct rg_result *result, const struct rg_table *table, int row)
{
    bool ok = rg_result_add_row(result, row);
    for (struct rg_place at = rg_result_start_row(row); ok && rg_result_next_in_row(result, &at);)
        ok = name_cell(result, table, at);
    return ok;
}
