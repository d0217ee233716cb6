#include "harness/record/rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/alloc.h"
#include "harness/record/facts.h"
#include "harness/record/passport.h"

// --- writing ---

static json_t *samples_json(const struct rg_cell *cell)
{
    json_t *array = json_array();
    for (int i = 0; i < cell->sample_count; i++)
        json_array_append_new(array, json_real(cell->samples_ms[i]));
    return array;
}

// Passes, counters and facts have an order: lists of pairs.
static json_t *passes_json(const struct rg_cell *cell)
{
    json_t *array = json_array();
    for (int i = 0; i < cell->pass_count; i++)
        json_array_append_new(array, json_pack("[sf]", cell->passes[i].name, cell->passes[i].ms));
    return array;
}

static json_t *counters_json(const struct rg_cell *cell)
{
    json_t *array = json_array();
    for (int i = 0; i < cell->counter_count; i++)
        json_array_append_new(
            array, json_pack("[sI]", cell->counters[i].name, (json_int_t)cell->counters[i].value));
    return array;
}

static json_t *facts_json(const struct rg_cell *cell)
{
    json_t *array = json_array();
    for (int i = 0; i < cell->fact_count; i++) {
        const struct rg_fact *fact = &cell->facts[i];
        json_array_append_new(array, json_pack("[so]", fact->name,
                                               *fact->text ? rg_json_text(fact->text)
                                                           : rg_number_json(fact->number)));
    }
    return array;
}

static json_t *cell_json(const struct rg_cell *cell)
{
    return json_pack("{sssosfsfsisosfsisososo}", "status", rg_outcome_name(cell->status), "detail",
                     rg_json_text(cell->detail), "create_ms", cell->create_ms, "first_frame_ms",
                     cell->first_frame_ms, "frames_a_sample", cell->frames_a_sample, "samples_ms",
                     samples_json(cell), "api_over_wall", cell->api_over_wall, "pass_frames",
                     cell->pass_frames, "passes", passes_json(cell), "counters",
                     counters_json(cell), "facts", facts_json(cell));
}

static json_t *group_json(const struct rg_table_group *group)
{
    return json_pack("{sssosfsfsi}", "status", rg_outcome_name(group->error_status), "detail",
                     rg_json_text(group->error_detail), "flip_mask_mean",
                     group->error.flip_mask_mean, "flip_mean", group->error.flip_mean, "max",
                     group->error.max_codes);
}

json_t *rg_journal_row_json(const struct rg_table_run *run, int row)
{
    json_t *errors = json_array(), *cells = json_array();
    for (int v = 0; v < rg_table_variant_count(run->table); v++) {
        json_array_append_new(errors, group_json(rg_table_group(run, row, v)));
        for (int d = 0; d < run->devices->count; d++)
            json_array_append_new(cells, cell_json(rg_table_cell(run, row, v, d)));
    }
    return json_pack("{soso}", "errors", errors, "cells", cells);
}

// --- reading ---

static bool read_samples(const json_t *array, struct rg_cell *cell)
{
    const size_t count = json_array_size(array);
    if (!count)
        return json_is_array(array);
    cell->samples_ms = rg_alloc(count, sizeof(double), "samples");
    for (size_t i = 0; cell->samples_ms && i < count; i++) {
        const double ms = json_number_value(json_array_get(array, i));
        if (!(ms > 0))
            return false;
        cell->samples_ms[cell->sample_count++] = ms;
    }
    return cell->samples_ms && rg_cell_summarise(cell);
}

static bool read_passes(const json_t *array, struct rg_cell *cell)
{
    for (size_t i = 0; i < json_array_size(array); i++) {
        struct rg_cell_pass pass;
        if (i == RG_MAX_CELL_PASSES ||
            json_unpack(json_array_get(array, i), "[sF]", &pass.name, &pass.ms))
            return false;
        cell->passes[cell->pass_count++] = pass;
    }
    return json_is_array(array);
}

static bool read_counters(const json_t *array, struct rg_cell *cell)
{
    for (size_t i = 0; i < json_array_size(array); i++) {
        const char *name;
        json_int_t value;
        if (i == RG_MAX_COUNTERS || json_unpack(json_array_get(array, i), "[sI]", &name, &value))
            return false;
        cell->counters[cell->counter_count++] = (struct rg_counter){name, value};
    }
    return json_is_array(array);
}

static bool read_facts(const json_t *array, struct rg_cell *cell)
{
    for (size_t i = 0; i < json_array_size(array); i++) {
        struct rg_fact fact = {.number = NAN};
        json_t *value;
        if (i == RG_MAX_FACTS || json_unpack(json_array_get(array, i), "[so]", &fact.name, &value))
            return false;
        if (json_is_string(value))
            snprintf(fact.text, sizeof(fact.text), "%s", json_string_value(value));
        else if (json_is_number(value))
            fact.number = json_number_value(value);
        cell->facts[cell->fact_count++] = fact;
    }
    return json_is_array(array);
}

static bool read_cell(json_t *json, struct rg_cell *cell, bool is_timed)
{
    const char *status, *detail;
    json_t *samples, *passes, *counters, *facts;
    if (json_unpack(json, "{sssssFsFsisosFsisososo}", "status", &status, "detail", &detail,
                    "create_ms", &cell->create_ms, "first_frame_ms", &cell->first_frame_ms,
                    "frames_a_sample", &cell->frames_a_sample, "samples_ms", &samples,
                    "api_over_wall", &cell->api_over_wall, "pass_frames", &cell->pass_frames,
                    "passes", &passes, "counters", &counters, "facts", &facts) ||
        !rg_outcome_find(status, &cell->status))
        return false;
    snprintf(cell->detail, sizeof(cell->detail), "%s", detail);
    const bool wants_samples = is_timed && cell->status == RG_OK;
    return wants_samples == (json_array_size(samples) > 0) && read_samples(samples, cell) &&
           read_passes(passes, cell) && read_counters(counters, cell) && read_facts(facts, cell);
}

static bool read_group(json_t *json, struct rg_table_group *group)
{
    const char *status, *detail;
    if (json_unpack(json, "{sssssFsFsi}", "status", &status, "detail", &detail, "flip_mask_mean",
                    &group->error.flip_mask_mean, "flip_mean", &group->error.flip_mean, "max",
                    &group->error.max_codes) ||
        !rg_outcome_find(status, &group->error_status))
        return false;
    snprintf(group->error_detail, sizeof(group->error_detail), "%s", detail);
    return true;
}

// What was read of a row that turned out to be none.
static void forget_row(struct rg_table_run *run, int row)
{
    for (int v = 0; v < rg_table_variant_count(run->table); v++) {
        *rg_table_group(run, row, v) = (struct rg_table_group){0};
        for (int d = 0; d < run->devices->count; d++) {
            struct rg_cell *cell = rg_table_cell(run, row, v, d);
            rg_cell_free(cell);
            *cell = (struct rg_cell){0};
        }
    }
}

bool rg_journal_row_read(const json_t *json, struct rg_table_run *run, int row)
{
    const struct rg_table *table = run->table;
    const json_t *errors = json_object_get(json, "errors"), *cells = json_object_get(json, "cells");
    const int variants = rg_table_variant_count(table), devices = run->devices->count;
    bool ok = json_array_size(errors) == (size_t)variants &&
              json_array_size(cells) == (size_t)(variants * devices);
    for (int v = 0; ok && v < variants; v++)
        ok = read_group(json_array_get(errors, (size_t)v), rg_table_group(run, row, v));
    for (int i = 0; ok && i < variants * devices; i++) {
        struct rg_cell *cell = rg_table_cell(run, row, i / devices, i % devices);
        *cell = (struct rg_cell){.technique = rg_technique_find(table->technique),
                                 .device = run->devices->devices[i % devices]};
        ok = read_cell(json_array_get(cells, (size_t)i), cell, !table->is_of_textures);
    }
    if (!ok)
        forget_row(run, row);
    return ok;
}
