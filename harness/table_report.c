// A measured table as JSON and as a grid.
#include "harness/table.h"

#include <string.h>

#include "harness/passport.h"
#include "harness/timer_audit.h"

static double fps_of(const struct rg_cell *cell)
{
    return 1000 / cell->frame_ms.median;
}

// The cell of cpu:reference in this row, or NULL.
static const struct rg_cell *reference_of(const struct rg_table_run *run, int row)
{
    for (int d = 0; d < run->devices->count; d++)
        if (!strcmp(run->devices->devices[d]->info.name, "cpu:reference"))
            return rg_table_cell(run, row, d);
    return NULL;
}

// --- JSON ---

static json_t *measured_json(const struct rg_cell *cell)
{
    json_t *samples = json_array(), *passes = json_object();
    for (int i = 0; i < cell->sample_count; i++)
        json_array_append_new(samples, json_real(cell->samples_ms[i]));
    for (int i = 0; i < cell->pass_count; i++)
        json_object_set_new(passes, cell->passes[i].name, json_real(cell->passes[i].ms));
    return json_pack("{sfsfsfsfsfsfsfsisoso}", "fps", fps_of(cell), "ms", cell->frame_ms.median,
                     "ms_low", cell->frame_ms.low, "ms_high", cell->frame_ms.high, "create_ms",
                     cell->create_ms, "first_frame_ms", cell->first_frame_ms, "api_over_wall",
                     cell->api_over_wall, "frames_a_sample", cell->frames_a_sample, "samples_ms",
                     samples, "passes_ms", passes);
}

static json_t *counters_json(const struct rg_cell *cell)
{
    json_t *counters = json_object();
    for (int i = 0; i < cell->counter_count; i++)
        json_object_set_new(counters, cell->counters[i].name,
                            json_integer(cell->counters[i].value));
    return counters;
}

static json_t *cell_json(const struct rg_table_run *run, int row, int device)
{
    const struct rg_cell *cell = rg_table_cell(run, row, device);
    const struct rg_table_row *printed = &run->table->rows[row];
    json_t *json = json_pack("{s{sf}sssssss{sf}so}", "row", run->table->axis, printed->axis,
                             "device", cell->device->info.name, "variant", "full", "status",
                             rg_cell_status_name(cell->status), "published", "fps", printed->fps,
                             "counters", counters_json(cell));
    if (cell->status == RG_CELL_OK)
        json_object_set_new(json, "measured", measured_json(cell));
    else
        json_object_set_new(json, "detail", json_string(cell->detail));
    return json;
}

static json_t *shape_json(const struct rg_table_run *run, int device)
{
    const struct rg_shape shape = rg_table_shape(run, device);
    return json_pack("{sssssbsfsf}", "device", run->devices->devices[device]->info.name, "verdict",
                     rg_shape_verdict_text(shape.verdict), "same_ranking", shape.same_ranking,
                     "slope", shape.slope, "published_slope", shape.published_slope);
}

json_t *rg_table_json(const struct rg_table_run *run)
{
    struct rg_device_info infos[RG_MAX_DEVICES];
    json_t *cells = json_array(), *shapes = json_array();
    for (int row = run->first_row; row <= run->last_row; row++)
        for (int d = 0; d < run->devices->count; d++)
            json_array_append_new(cells, cell_json(run, row, d));
    for (int d = 0; d < run->devices->count; d++) {
        infos[d] = run->devices->devices[d]->info;
        json_array_append_new(shapes, shape_json(run, d));
    }
    return json_pack("{sisssssssososo}", "format", 1, "table", run->table->id, "hardware",
                     run->table->hardware, "length", run->full ? "full" : "quick", "passport",
                     rg_passport_json(infos, run->devices->count), "cells", cells, "shapes",
                     shapes);
}

// --- the grid ---

enum { AXIS, PUBLISHED, DEVICE, FPS, MS, MS_RANGE, RATIO, TIMES, FIRST, API, COLUMNS };

static void fill_measured(char (*cells)[RG_GRID_CELL], const struct rg_cell *cell,
                          const struct rg_cell *reference, double published_fps)
{
    snprintf(cells[FPS], RG_GRID_CELL, "%.1f", fps_of(cell));
    snprintf(cells[MS], RG_GRID_CELL, "%.3f", cell->frame_ms.median);
    snprintf(cells[MS_RANGE], RG_GRID_CELL, "%.3f to %.3f", cell->frame_ms.low,
             cell->frame_ms.high);
    snprintf(cells[RATIO], RG_GRID_CELL, "%.2f", fps_of(cell) / published_fps);
    if (reference && reference->status == RG_CELL_OK)
        snprintf(cells[TIMES], RG_GRID_CELL, "%.1f", fps_of(cell) / fps_of(reference));
    snprintf(cells[FIRST], RG_GRID_CELL, "%.1f", cell->first_frame_ms);
    const bool trusted = rg_timer_is_trusted(cell->api_over_wall);
    snprintf(cells[API], RG_GRID_CELL, "%.2f%s", cell->api_over_wall, trusted ? "" : " untrusted");
}

static void add_row(const struct rg_table_run *run, struct rg_grid *grid, int row, int device)
{
    const struct rg_table_row *printed = &run->table->rows[row];
    const struct rg_cell *cell = rg_table_cell(run, row, device);
    char(*cells)[RG_GRID_CELL] = rg_grid_row(grid);
    if (!cells)
        return;
    snprintf(cells[AXIS], RG_GRID_CELL, "%.10g", printed->axis);
    snprintf(cells[PUBLISHED], RG_GRID_CELL, "%.10g", printed->fps);
    snprintf(cells[DEVICE], RG_GRID_CELL, "%s", cell->device->info.name);
    if (cell->status == RG_CELL_OK) {
        fill_measured(cells, cell, reference_of(run, row), printed->fps);
        return;
    }
    snprintf(cells[FPS], RG_GRID_CELL, "%s", rg_cell_status_name(cell->status));
    rg_grid_note(grid, "%s %.10g on %s: %s", run->table->axis, printed->axis,
                 cell->device->info.name, cell->detail);
}

static void add_shape(const struct rg_table_run *run, struct rg_grid *grid, int device)
{
    const struct rg_shape shape = rg_table_shape(run, device);
    if (shape.verdict == RG_SHAPE_UNKNOWN)
        return;
    rg_grid_note(grid,
                 "Shape on %s: %s. fps %s the published order; it goes with %s to the power %.2f, "
                 "published %.2f.",
                 run->devices->devices[device]->info.name, rg_shape_verdict_text(shape.verdict),
                 shape.same_ranking ? "keeps" : "does not keep", run->table->axis, shape.slope,
                 shape.published_slope);
}

void rg_table_grid(const struct rg_table_run *run, struct rg_grid *grid)
{
    *grid = (struct rg_grid){
        .title = run->table->id,
        .column_count = COLUMNS,
        .columns = {[AXIS] = run->table->axis,
                    [PUBLISHED] = "published fps",
                    [DEVICE] = "device",
                    [FPS] = "fps",
                    [MS] = "ms",
                    [MS_RANGE] = "ms, 95 %",
                    [RATIO] = "fps / published",
                    [TIMES] = "x cpu:reference",
                    [FIRST] = "first frame ms",
                    [API] = "API / wall clock"},
    };
    for (int row = run->first_row; row <= run->last_row; row++)
        for (int d = 0; d < run->devices->count; d++)
            add_row(run, grid, row, d);
    for (int d = 0; d < run->devices->count; d++)
        add_shape(run, grid, d);
    rg_grid_note(
        grid,
        "Published on %s. Times are wall clock between full syncs, medians of %d samples (%s).",
        run->table->hardware, run->cell_count ? run->cells[0].sample_count : 0,
        run->full ? "full" : "quick");
    rg_grid_note(grid, "%s", run->table->note);
}
