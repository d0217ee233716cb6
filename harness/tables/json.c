// A measured table as JSON (docs/records.md).
#include <math.h>
#include <stdlib.h>

#include "harness/record/facts.h"
#include "harness/record/passport.h"
#include "harness/tables/table.h"

static json_t *samples_json(const struct rg_cell *cell)
{
    json_t *samples = json_array();
    for (int i = 0; i < cell->sample_count; i++)
        json_array_append_new(samples, json_real(cell->samples_ms[i]));
    return samples;
}

// Milliseconds a frame divided by `unit`.
static json_t *passes_json(const struct rg_cell *cell, double unit)
{
    json_t *passes = json_object();
    for (int i = 0; i < cell->pass_count; i++)
        json_object_set_new(passes, cell->passes[i].name, json_real(cell->passes[i].ms / unit));
    return passes;
}

static json_t *times_json(const struct rg_cell *cell)
{
    return json_pack("{sfsfsfsfsfsfsfsisosisoso}", "fps", rg_cell_fps(cell), "ms",
                     cell->frame_ms.median, "ms_low", cell->frame_ms.low, "ms_high",
                     cell->frame_ms.high, "create_ms", cell->create_ms, "first_frame_ms",
                     cell->first_frame_ms, "api_over_wall", cell->api_over_wall, "frames_a_sample",
                     cell->frames_a_sample, "samples_ms", samples_json(cell), "pass_frames",
                     cell->pass_frames, "passes_ms", passes_json(cell, 1), "passes_share",
                     passes_json(cell, rg_cell_passes_ms(cell)));
}

static json_t *measured_json(const struct rg_table *table, const struct rg_cell *cell)
{
    json_t *json = table->is_of_textures ? json_object() : times_json(cell);
    for (int c = 0; table->columns[c]; c++) {
        const double *told = rg_facts_number(cell->facts, cell->fact_count, table->columns[c]);
        if (told && rg_table_is_extra(table, c))
            json_object_set_new(json, table->columns[c], rg_number_json(*told));
    }
    return json;
}

// What tells the row from others: its name, the keys.
static json_t *row_json(const struct rg_table *table, int row)
{
    json_t *json = json_object();
    if (table->names)
        json_object_set_new(json, table->names, json_string(table->rows[row].name));
    for (int c = 0; c < table->key_count; c++)
        json_object_set_new(json, table->columns[c], rg_number_json(table->rows[row].values[c]));
    return json;
}

static json_t *published_json(const struct rg_table *table, int row, int variant)
{
    json_t *json = json_object();
    if (rg_table_is_published(table) && !table->is_of_textures)
        json_object_set_new(json, "fps",
                            rg_number_json(rg_table_published_fps(table, row, variant)));
    for (int c = 0; table->columns[c]; c++)
        if (rg_table_is_extra(table, c))
            json_object_set_new(json, table->columns[c],
                                rg_number_json(table->rows[row].values[c]));
    return json;
}

// As `render` takes it after --set, one assignment each.
static json_t *set_json(const struct rg_table_run *run, int row, int variant)
{
    char *text = rg_table_assignments(run, row, variant);
    json_t *json = text ? json_string(text) : json_null();
    free(text);
    return json;
}

static json_t *error_json(const struct rg_table_group *group)
{
    if (group->error_status != RG_OK)
        return json_pack("{ssso}", "status", rg_outcome_name(group->error_status), "detail",
                         rg_json_text(group->error_detail));
    return json_pack("{sssfsfsi}", "status", "ok", "flip_mask_mean", group->error.flip_mask_mean,
                     "flip_mean", group->error.flip_mean, "max", group->error.max_codes);
}

static json_t *cell_json(const struct rg_table_run *run, int row, int variant, int device)
{
    const struct rg_table *table = run->table;
    const struct rg_cell *cell = rg_table_cell(run, row, variant, device);
    const struct rg_table_group *group = rg_table_group(run, row, variant);
    json_t *json = json_pack(
        "{sosossssssso}", "row", row_json(table, row), "set", set_json(run, row, variant), "device",
        cell->device->info.name, "variant", table->variants[variant].name, "status",
        rg_outcome_name(cell->status), "published", published_json(table, row, variant));
    json_object_set_new(json, "counters", rg_counters_json(cell->counters, cell->counter_count));
    json_object_set_new(json, "facts", rg_facts_json(cell->facts, cell->fact_count));
    if (table->truth)
        json_object_set_new(json, "error", error_json(group));
    if (cell->status == RG_OK)
        json_object_set_new(json, "measured", measured_json(table, cell));
    else
        json_object_set_new(json, "detail", rg_json_text(cell->detail));
    return json;
}

static json_t *trend_json(const struct rg_table_run *run, int variant, int device)
{
    const struct rg_trend s = rg_table_trend(run, variant, device);
    const bool known = s.verdict != RG_TREND_UNKNOWN;
    const double slope = known && !s.has_slope ? NAN : s.slope;
    const double published = known && !s.has_slope ? NAN : s.published_slope;
    return json_pack("{sssssssbsisisoso}", "device", run->devices->devices[device]->info.name,
                     "variant", run->table->variants[variant].name, "verdict",
                     rg_trend_text(s.verdict), "same_ranking", s.pairs_in_order == s.pairs, "pairs",
                     s.pairs, "pairs_in_order", s.pairs_in_order, "slope", rg_number_json(slope),
                     "published_slope", rg_number_json(published));
}

// One sentence for each device that a reader would look for in vain.
static json_t *missing_json(const struct rg_devices *devices)
{
    json_t *missing = json_array();
    for (int i = 0; devices->missing[i][0]; i++)
        json_array_append_new(missing, rg_json_text(devices->missing[i]));
    for (int i = 0; i < devices->broken_count; i++)
        json_array_append_new(missing, rg_json_text(devices->broken[i].why));
    return missing;
}

json_t *rg_table_json(const struct rg_table_run *run)
{
    struct rg_device_info infos[RG_MAX_DEVICES];
    json_t *cells = json_array(), *shapes = json_array();
    const struct rg_table *table = run->table;
    const int variants = rg_table_variant_count(table), devices = run->devices->count;
    const int end = rg_table_first_missing(run);
    for (int row = run->first_row; row < end; row++)
        for (int i = 0; i < variants * devices; i++)
            json_array_append_new(cells, cell_json(run, row, i / devices, i % devices));
    for (int i = 0; !table->is_of_textures && i < variants * devices; i++)
        json_array_append_new(shapes, trend_json(run, i / devices, i % devices));
    for (int d = 0; d < devices; d++)
        infos[d] = run->devices->devices[d]->info;
    return json_pack("{sissss?sssbsisosososo}", "format", 1, "table", table->id, "hardware",
                     table->hardware, "length", run->full ? "full" : "quick", "interrupted",
                     end <= run->last_row, "resumed_rows", run->resumed_rows, "passport",
                     rg_passport_json(infos, devices), "missing", missing_json(run->devices),
                     "cells", cells, "shapes", shapes);
}
