// Results as JSON.
#include <string.h>

#include "harness/record/schema/schema.h"

// A number for each sample.
static json_t *samples_json(const struct rg_record *record, const double *numbers)
{
    json_t *samples = json_array();
    for (int i = 0; i < record->sample_count; i++)
        json_array_append_new(samples, json_real(numbers[i]));
    return samples;
}

// [number, ms, stolen, others, seconds] of each launch.
static json_t *launches_json(const struct rg_record *record)
{
    json_t *launches = json_array();
    for (int i = 0; i < record->launch_count; i++) {
        const struct rg_launch *l = &record->launches[i];
        json_array_append_new(
            launches, json_pack("[iffff]", l->number, l->ms, l->stolen, l->others, l->seconds));
    }
    return launches;
}

// Milliseconds a frame divided by `unit`.
static json_t *passes_json(const struct rg_record *record, double unit)
{
    json_t *passes = json_object();
    for (int i = 0; i < record->pass_count; i++)
        json_object_set_new(passes, record->passes[i].name, json_real(record->passes[i].ms / unit));
    return passes;
}

static json_t *times_json(const struct rg_record *record)
{
    json_t *json = json_pack(
        "{sfsfsososfsfsfsisosisoso}", "fps", rg_record_fps(record), "ms", record->frame_ms.median,
        "ms_low", rg_number_json(record->frame_ms.low), "ms_high",
        rg_number_json(record->frame_ms.high), "create_ms", record->create_ms, "first_frame_ms",
        record->first_frame_ms, "api_over_wall", record->api_over_wall, "frames_a_sample",
        record->frames_a_sample, "samples_ms", samples_json(record, record->samples_ms),
        "pass_frames", record->pass_frames, "passes_ms", passes_json(record, 1), "passes_share",
        passes_json(record, rg_record_passes_ms(record)));
    if (rg_record_noise(record) > 0)
        json_object_set_new(json, "noise", json_real(rg_record_noise(record)));
    if (record->is_watched) {
        json_object_set_new(json, "taken", samples_json(record, record->taken));
        json_object_set_new(json, "disturbed", json_integer(rg_record_disturbed(record)));
        json_object_set_new(json, "retaken", json_integer(record->retaken));
    }
    if (!rg_record_is_whole(record))
        json_object_set_new(json, "samples_wanted", json_integer(record->wanted_samples));
    if (record->launch_count)
        json_object_set_new(json, "launches", launches_json(record));
    if (record->calibration_begin_ms > 0) {
        json_object_set_new(json, "calibration_begin_ms", json_real(record->calibration_begin_ms));
        json_object_set_new(json, "calibration_end_ms", json_real(record->calibration_end_ms));
    }
    return json;
}

// A number that the paper printed, other than a frame rate, is written with the fact of the same
// name.
static json_t *measured_json(const struct rg_record *record, bool is_timed)
{
    json_t *json = is_timed ? times_json(record) : json_object();
    for (int i = 0; i < record->published_count; i++) {
        const char *name = record->published[i].name;
        const double *told = rg_named_number(record->facts, record->fact_count, name);
        if (told && strcmp(name, "fps") != 0)
            json_object_set_new(json, name, rg_number_json(*told));
    }
    return json;
}

static json_t *error_json(const struct rg_truth_error *error)
{
    if (error->outcome != RG_OK) {
        json_t *json = json_object();
        rg_outcome_set(json, error->outcome);
        json_object_set_new(json, "detail", rg_json_text(error->detail));
        return json;
    }
    return json_pack("{sssfsfsi}", "status", "ok", "flip_mask_mean", error->flip_mask_mean,
                     "flip_mean", error->flip_mean, "max", error->max_codes);
}

static json_t *cell_json(const struct rg_result *result, struct rg_place at)
{
    const struct rg_record *record = rg_result_at(result, at);
    json_t *json = json_pack("{sosisososs}", "row", rg_named_json(record->row, record->row_count),
                             "row_number", at.row + 1, "set", rg_json_text(record->set), "device",
                             rg_json_text(record->device.name), "variant", record->variant);
    if (*record->work)
        json_object_set_new(json, "work", json_string(record->work));
    rg_outcome_set(json, record->outcome);
    json_object_set_new(json, "published",
                        rg_named_json(record->published, record->published_count));
    json_object_set_new(json, "counters", rg_counts_json(record->counters, record->counter_count));
    json_object_set_new(json, "tally",
                        record->has_tally ? rg_tally_json(&record->tally) : json_null());
    if (record->counted_count)
        json_object_set_new(json, "counted",
                            rg_counts_json(record->counted, record->counted_count));
    json_object_set_new(json, "facts", rg_named_json(record->facts, record->fact_count));
    if (*result->truth)
        json_object_set_new(json, "error", error_json(&record->truth_error));
    if (record->outcome == RG_OK)
        json_object_set_new(json, "measured", measured_json(record, !result->is_of_textures));
    else
        json_object_set_new(json, "detail", rg_json_text(record->detail));
    return json;
}

static json_t *cells_json(const struct rg_result *result)
{
    json_t *cells = json_array();
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);)
        json_array_append_new(cells, cell_json(result, at));
    return cells;
}

static json_t *missing_json(const struct rg_result *result)
{
    json_t *missing = json_array();
    for (int i = 0; i < result->missing_count; i++)
        json_array_append_new(missing, rg_json_text(result->missing[i]));
    return missing;
}

static json_t *variants_json(const struct rg_result *result)
{
    json_t *variants = json_array();
    for (int i = 0; i < result->variant_count; i++)
        json_array_append_new(variants, json_string(result->variants[i]));
    return variants;
}

static json_t *works_json(const struct rg_result *result)
{
    json_t *works = json_array();
    for (int i = 0; i < result->work_count; i++) {
        const struct rg_result_work *work = &result->works[i];
        json_t *json = json_pack("{ssso}", "name", work->name, "saves", rg_json_text(work->saves));
        if (*work->reading)
            json_object_set_new(json, "reading", rg_json_text(work->reading));
        json_array_append_new(works, json);
    }
    return works;
}

// Text, or null if there is none.
static json_t *text_or_null(const char *text)
{
    return *text ? rg_json_text(text) : json_null();
}

// The head: the table, and the part of it that was to be measured.
static json_t *head_json(const struct rg_result *result)
{
    return json_pack("{sisssosssbsisss[ii]sisbs[ii]sosososo}", "format", RG_FORMAT_VERSION, "table",
                     result->table, "hardware", text_or_null(result->hardware), "length",
                     result->full ? "full" : "quick", "interrupted",
                     rg_result_first_missing(result) <= result->last_row, "resumed_rows",
                     result->resumed_rows, "technique", result->technique, "size_px", result->width,
                     result->height, "check_frames", result->check_frames, "timed",
                     !result->is_of_textures, "rows", result->first_row + 1, result->last_row + 1,
                     "variants", variants_json(result), "truth", text_or_null(result->truth),
                     "quick", text_or_null(result->quick), "note", rg_json_text(result->note));
}

static bool leaves_out(const struct rg_result *result)
{
    bool any = false;
    for (int row = result->first_row; row <= result->last_row; row++)
        any = any || !rg_result_wants(result, row);
    return any;
}

// The rows that a budget or quick mode leaves out, counted from 1.
static json_t *left_out_json(const struct rg_result *result)
{
    json_t *rows = json_array();
    for (int row = result->first_row; row <= result->last_row; row++)
        if (!rg_result_wants(result, row))
            json_array_append_new(rows, json_integer(row + 1));
    return rows;
}

// The choices of a budget.
static json_t *budget_json(const struct rg_result *result)
{
    return json_pack("{sfsisbso}", "seconds", result->budget_s, "size_divisor",
                     result->size_divisor, "few_samples", result->few_samples, "left_out",
                     left_out_json(result));
}

json_t *rg_result_json(const struct rg_result *result)
{
    json_t *json = head_json(result);
    if (result->work_count)
        json_object_set_new(json, "works", works_json(result));
    if (result->budget_s > 0)
        json_object_set_new(json, "budget", budget_json(result));
    else if (leaves_out(result))
        json_object_set_new(json, "left_out", left_out_json(result));
    if (*result->changed)
        json_object_set_new(json, "changed", rg_json_text(result->changed));
    json_object_set(json, "passport", result->passport);
    json_object_set_new(json, "missing", missing_json(result));
    json_object_set_new(json, "cells", cells_json(result));
    return json;
}
