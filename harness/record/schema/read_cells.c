// Reads results from JSON, strictly: a document may come from another program, or be cut off.
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/record/schema/read.h"
#include "harness/record/schema/schema.h"

// --- measurements ---

static bool read_samples(struct rg_reader *r, const json_t *measured, struct rg_record *record)
{
    int count;
    const json_t *array = rg_field_array(r, measured, "samples_ms", RG_MAX_SAMPLES, &count);
    for (int i = 0; i < count; i++) {
        const double ms = json_number_value(json_array_get(array, (size_t)i));
        if (!(ms > 0))
            return rg_reader_refuse(r, "samples_ms", "has an element that is no number above 0");
        record->samples_ms[record->sample_count++] = ms;
    }
    return count > 0;
}

// Reads the share that others took of each sample. Older results lack it.
static bool read_taken(struct rg_reader *r, const json_t *measured, struct rg_record *record)
{
    const json_t *array = json_object_get(measured, "taken");
    if (!array)
        return true;
    record->is_watched = true;
    if (json_array_size(array) != (size_t)record->sample_count)
        return rg_reader_refuse(r, "taken", "has not a number for each sample");
    for (int i = 0; i < record->sample_count; i++) {
        const json_t *share = json_array_get(array, (size_t)i);
        record->taken[i] = json_number_value(share);
        if (!json_is_number(share) || record->taken[i] < 0 || record->taken[i] > 1)
            return rg_reader_refuse(r, "taken", "has an element that is no number from 0 to 1");
    }
    return rg_field_int(r, measured, "retaken", 0, INT_MAX, &record->retaken);
}

static bool read_passes(struct rg_reader *r, const json_t *measured, struct rg_record *record)
{
    struct rg_named passes[RG_MAX_PASS_TIMES];
    if (!rg_field_named(r, measured, "passes_ms", passes, RG_MAX_PASS_TIMES, &record->pass_count))
        return false;
    for (int i = 0; i < record->pass_count; i++) {
        if (!(passes[i].number >= 0))
            return rg_reader_refuse(r, "passes_ms", "has '%s', which is no number from 0 on",
                                    passes[i].name);
        memcpy(record->passes[i].name, passes[i].name, RG_NAME_SIZE);
        record->passes[i].ms = passes[i].number;
    }
    return true;
}

// A launch: its number, which rises, a time above 0, and three numbers that are not negative.
static bool take_launch(const json_t *json, int after, struct rg_launch *launch)
{
    double *const numbers[] = {&launch->ms, &launch->stolen, &launch->others, &launch->seconds};
    bool ok = json_array_size(json) == 5 && json_is_integer(json_array_get(json, 0));
    const json_int_t number = json_integer_value(json_array_get(json, 0));
    for (size_t i = 0; i < 4; i++) {
        const json_t *value = json_array_get(json, i + 1);
        *numbers[i] = json_number_value(value);
        ok = ok && json_is_number(value) && *numbers[i] >= 0;
    }
    launch->number = ok && number > after && number <= INT_MAX ? (int)number : 0;
    return launch->number && launch->ms > 0;
}

// Reads launches. Cells that no claim needed have none.
static bool read_launches(struct rg_reader *r, const json_t *measured, struct rg_record *record)
{
    int count, after = 0;
    if (!json_object_get(measured, "launches"))
        return true;
    const json_t *array = rg_field_array(r, measured, "launches", RG_MAX_LAUNCHES, &count);
    for (int i = 0; i < count; i++) {
        if (!take_launch(json_array_get(array, (size_t)i), after, &record->launches[i]))
            return rg_reader_refuse(r, "launches",
                                    "has an element that is no [number, ms, stolen, others, "
                                    "seconds], or numbers do not rise");
        after = record->launches[i].number;
    }
    record->launch_count = count;
    return count > 0;
}

// Reads the calibration's times. Older results lack them.
static bool read_calibration(struct rg_reader *r, const json_t *measured, struct rg_record *record)
{
    return !json_object_get(measured, "calibration_begin_ms") ||
           (rg_field_number(r, measured, "calibration_begin_ms", &record->calibration_begin_ms) &&
            rg_field_number(r, measured, "calibration_end_ms", &record->calibration_end_ms));
}

// Reads the number of samples wanted. An incomplete cell has no run that times passes.
static bool read_wanted(struct rg_reader *r, const json_t *measured, struct rg_record *record)
{
    record->wanted_samples = record->sample_count;
    if (json_object_get(measured, "samples_wanted"))
        return rg_field_int(r, measured, "samples_wanted", record->sample_count, RG_MAX_SAMPLES,
                            &record->wanted_samples) &&
               rg_field_int(r, measured, "pass_frames", 0, 0, &record->pass_frames);
    return rg_field_int(r, measured, "pass_frames", 1, INT_MAX, &record->pass_frames);
}

static bool read_measured(struct rg_reader *r, const json_t *cell, struct rg_record *record,
                          bool is_timed)
{
    const json_t *measured = rg_field(r, cell, "measured", JSON_OBJECT);
    char cell_place[sizeof(r->place)];
    memcpy(cell_place, r->place, sizeof(cell_place));
    rg_reader_enter(r, "%.60s.measured", cell_place);
    return measured &&
           (!is_timed ||
            (rg_field_number(r, measured, "create_ms", &record->create_ms) &&
             rg_field_number(r, measured, "first_frame_ms", &record->first_frame_ms) &&
             rg_field_number(r, measured, "api_over_wall", &record->api_over_wall) &&
             rg_field_int(r, measured, "frames_a_sample", 1, INT_MAX, &record->frames_a_sample) &&
             read_samples(r, measured, record) && read_taken(r, measured, record) &&
             read_launches(r, measured, record) && read_wanted(r, measured, record) &&
             read_calibration(r, measured, record) && read_passes(r, measured, record)));
}

static bool read_outcome(struct rg_reader *r, const json_t *object, enum rg_outcome *outcome,
                         char detail[RG_DETAIL_SIZE])
{
    char name[16];
    if (!rg_field_text(r, object, "status", name, sizeof(name)))
        return false;
    if (!rg_outcome_find(name, outcome))
        return rg_reader_refuse(r, "status", "is no outcome");
    const char *const fault = json_string_value(json_object_get(object, "fault"));
    if (*outcome == RG_ERROR && fault && !strcmp(fault, rg_fault_name(RG_FAULT_HARNESS)))
        *outcome = RG_LACKING;
    if (*outcome == RG_ERROR && fault && !strcmp(fault, rg_fault_name(RG_FAULT_SETUP)))
        *outcome = RG_SETUP;
    return *outcome == RG_OK || rg_field_text(r, object, "detail", detail, RG_DETAIL_SIZE);
}

static bool read_truth_error(struct rg_reader *r, const json_t *cell, struct rg_truth_error *error)
{
    char cell_place[sizeof(r->place)];
    const json_t *json = rg_field(r, cell, "error", JSON_OBJECT);
    memcpy(cell_place, r->place, sizeof(cell_place));
    rg_reader_enter(r, "%.60s.error", cell_place);
    const bool ok = json && read_outcome(r, json, &error->outcome, error->detail) &&
                    (error->outcome != RG_OK ||
                     (rg_field_number(r, json, "flip_mask_mean", &error->flip_mask_mean) &&
                      rg_field_number(r, json, "flip_mean", &error->flip_mean) &&
                      rg_field_int(r, json, "max", 0, 255, &error->max_codes)));
    if (ok)
        memcpy(r->place, cell_place, sizeof(cell_place));
    return ok;
}

static bool read_tally(struct rg_reader *r, const json_t *cell, struct rg_record *record)
{
    if (json_is_null(json_object_get(cell, "tally")))
        return true;
    record->has_tally = rg_field_tally(r, cell, "tally", &record->tally);
    return record->has_tally;
}

static bool read_record(struct rg_reader *r, const json_t *cell, const struct rg_result *result,
                        struct rg_record *record)
{
    if (!rg_field_text(r, cell, "set", record->set, sizeof(record->set)) ||
        !rg_field_named(r, cell, "row", record->row, RG_MAX_VALUES, &record->row_count) ||
        !rg_field_named(r, cell, "published", record->published, RG_MAX_VALUES,
                        &record->published_count) ||
        !rg_field_counts(r, cell, "counters", record->counters, RG_MAX_COUNTERS,
                         &record->counter_count) ||
        !read_tally(r, cell, record) ||
        (json_object_get(cell, "counted") &&
         !rg_field_counts(r, cell, "counted", record->counted, RG_MAX_COUNTED,
                          &record->counted_count)) ||
        !rg_field_named(r, cell, "facts", record->facts, RG_MAX_FACTS, &record->fact_count) ||
        !read_outcome(r, cell, &record->outcome, record->detail) ||
        (*result->truth && !read_truth_error(r, cell, &record->truth_error)))
        return false;
    if (record->outcome == RG_OK && !read_measured(r, cell, record, !result->is_of_textures))
        return false;
    rg_record_settle(record);
    return true;
}

// --- cells ---

// The index of a name among `count` names, which lie `stride` bytes apart; `count` if it is none of
// them.
static int find(const char *names, size_t stride, int count, const char *name)
{
    int i = 0;
    while (i < count && strcmp(names + (size_t)i * stride, name) != 0)
        i++;
    return i;
}

// Reads the place of a cell from its row's number and its names.
static bool read_place(struct rg_reader *r, const json_t *cell, const struct rg_result *result,
                       struct rg_place *place)
{
    char device[RG_NAME_SIZE], variant[RG_NAME_SIZE], work[RG_NAME_SIZE] = "";
    if (!rg_field_int(r, cell, "row_number", result->first_row + 1, result->last_row + 1,
                      &place->row) ||
        !rg_field_text(r, cell, "device", device, sizeof(device)) ||
        !rg_field_text(r, cell, "variant", variant, sizeof(variant)) ||
        (result->work_count && !rg_field_text(r, cell, "work", work, sizeof(work))))
        return false;
    place->row--;
    place->device =
        find(result->devices[0].name, sizeof(result->devices[0]), result->device_count, device);
    place->variant = find(result->variants[0], RG_NAME_SIZE, result->variant_count, variant);
    place->work = find(result->works[0].name, sizeof(result->works[0]), result->work_count, work);
    if (place->device == result->device_count)
        return rg_reader_refuse(r, "device", "is '%.40s', which the passport does not name",
                                device);
    if (place->variant == result->variant_count)
        return rg_reader_refuse(r, "variant", "is '%.40s', which 'variants' does not name",
                                variant);
    return !result->work_count || place->work < result->work_count ||
           rg_reader_refuse(r, "work", "is '%.40s', which 'works' does not name", work);
}

// Copies to a record the names of its place: technique, work, variant and device.
static void name_record(const struct rg_result *result, struct rg_place at,
                        struct rg_record *record)
{
    memcpy(record->technique, result->technique, sizeof(record->technique));
    memcpy(record->variant, result->variants[at.variant], sizeof(record->variant));
    if (result->work_count)
        memcpy(record->work, result->works[at.work].name, sizeof(record->work));
    record->device = result->devices[at.device];
}

// Reads a cell into its place. `rows_left`: rows that may still begin.
static bool read_cell(struct rg_reader *r, const json_t *cell, struct rg_result *result,
                      size_t *rows_left)
{
    struct rg_place at;
    if (!read_place(r, cell, result, &at))
        return false;
    if (!rg_result_has(result, at.row)) {
        if (!(*rows_left)--)
            return rg_reader_refuse(r, "row_number",
                                    "begins a row, and one before it is not whole");
        if (!rg_result_add_row(result, at.row))
            return false;
    }
    struct rg_record *record = rg_result_at(result, at);
    if (*record->variant)
        return rg_reader_refuse(r, "", "stands there twice");
    name_record(result, at, record);
    return read_record(r, cell, result, record);
}

bool rg_read_cells(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    const json_t *cells = rg_field(r, document, "cells", JSON_ARRAY), *cell;
    const size_t count = json_array_size(cells), a_row = (size_t)rg_result_row_cells(result);
    size_t i, rows_left = count / a_row;
    if (cells && count % a_row)
        return rg_reader_refuse(r, "cells", "has %zu elements, and a row has %zu cells", count,
                                a_row);
    // The number of cells is a multiple of a row's. No cell comes twice, and no more rows begin
    // than that number allows, so every row is complete.
    json_array_foreach(cells, i, cell)
    {
        rg_reader_enter(r, "cells[%zu]", i);
        if (!read_cell(r, cell, result, &rows_left))
            return false;
    }
    return cells != NULL;
}

bool rg_result_from_json(const json_t *document, const char *file, struct rg_result *result,
                         char why[RG_WHY_SIZE])
{
    struct rg_reader reader = {.file = file,
                               .mend = "name a file as `raingauge table -o` writes it",
                               .why = why,
                               .why_size = RG_WHY_SIZE};
    *why = 0;
    if (rg_read_head(&reader, document, result) && rg_read_cells(&reader, document, result))
        return true;
    if (!*why)
        snprintf(why, RG_WHY_SIZE, "%.200s: no memory for its cells; close other programs", file);
    rg_result_free(result);
    return false;
}
