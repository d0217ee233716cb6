#include "harness/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/alloc.h"
#include "core/log.h"
#include "harness/frame.h"
#include "harness/progress.h"

// Slopes closer than this, in powers of the axis, count as the same.
#define SAME_SLOPE 0.25

static const struct rg_measure_options quick = {.samples = 15, .sample_ms = 15};
static const struct rg_measure_options full = {.samples = 61, .sample_ms = 60};

static struct rg_cell *cell_at(const struct rg_table_run *run, int row, int device)
{
    return &run->cells[(row - run->first_row) * run->devices->count + device];
}

const struct rg_cell *rg_table_cell(const struct rg_table_run *run, int row, int device)
{
    return cell_at(run, row, device);
}

// The image that every cell of a row must show after RG_CELL_CHECK_FRAMES frames.
static void *make_reference(const struct rg_table *table, const struct rg_technique *technique,
                            const void *settings, size_t *size)
{
    struct rg_device *device = rg_device_open("cpu:reference", NULL);
    struct rg_instance *instance = device ? rg_frame_run(technique, settings, device, table->width,
                                                         table->height, RG_CELL_CHECK_FRAMES)
                                          : NULL;
    void *texels = instance ? rg_frame_read(instance, size) : NULL;
    if (instance)
        technique->destroy(instance);
    rg_device_close(device);
    return texels;
}

static bool prepare_row(struct rg_table_run *run, int row, struct rg_progress *progress)
{
    const struct rg_table *table = run->table;
    const struct rg_technique *technique = rg_technique_find(table->technique);
    void *settings = rg_settings_create(technique);
    run->settings[row - run->first_row] = settings;
    size_t size;
    void *reference = settings && rg_params_set(technique->params, settings, table->rows[row].set)
                          ? make_reference(table, technique, settings, &size)
                          : NULL;
    if (!reference)
        return false;
    for (int d = 0; d < run->devices->count; d++) {
        struct rg_cell *cell = cell_at(run, row, d);
        *cell = (struct rg_cell){.technique = technique,
                                 .settings = settings,
                                 .device = run->devices->devices[d],
                                 .width = table->width,
                                 .height = table->height};
        rg_cell_prepare(cell, reference, size);
        rg_progress_add(progress, 1);
    }
    free(reference);
    return true;
}

static void show_round(int done, int total, void *user)
{
    (void)done;
    (void)total;
    rg_progress_add(user, 1);
}

bool rg_table_measure(struct rg_table_run *run)
{
    const int rows = run->last_row - run->first_row + 1;
    struct rg_measure_options options = run->full ? full : quick;
    const int cells = rows * run->devices->count;
    run->cells = rg_alloc((size_t)cells, sizeof(*run->cells), run->table->id);
    run->settings = rg_alloc((size_t)rows, sizeof(*run->settings), run->table->id);
    if (!run->cells || !run->settings)
        return false;
    run->cell_count = cells;
    struct rg_progress progress;
    rg_progress_start(&progress, run->cell_count + options.samples);
    rg_progress_label(&progress, "%s", run->table->id);
    bool ok = true;
    for (int row = run->first_row; ok && row <= run->last_row; row++)
        ok = prepare_row(run, row, &progress);
    options.progress = show_round;
    options.user = &progress;
    if (ok)
        rg_cells_measure(run->cells, run->cell_count, &options);
    rg_progress_end(&progress);
    return ok;
}

void rg_table_run_free(struct rg_table_run *run)
{
    for (int i = 0; i < run->cell_count; i++)
        rg_cell_close(&run->cells[i]);
    for (int i = 0; run->settings && i <= run->last_row - run->first_row; i++)
        free(run->settings[i]);
    free(run->settings);
    free(run->cells);
}

// --- the shape: do the numbers fall as published? ---

const char *rg_shape_verdict_text(enum rg_shape_verdict verdict)
{
    static const char *const texts[] = {"reproduced", "trend only", "not reproduced",
                                        "not comparable"};
    return texts[verdict];
}

struct rg_shape rg_table_shape(const struct rg_table_run *run, int device)
{
    enum { MAX_ROWS = 64 };
    double axis[MAX_ROWS], published[MAX_ROWS], measured[MAX_ROWS];
    struct rg_shape shape = {.verdict = RG_SHAPE_UNKNOWN, .same_ranking = true};
    int rows = 0;
    for (int row = run->first_row; row <= run->last_row && rows < MAX_ROWS; row++, rows++) {
        const struct rg_cell *cell = cell_at(run, row, device);
        if (cell->status != RG_CELL_OK)
            return shape;
        axis[rows] = log(run->table->rows[row].axis);
        published[rows] = log(run->table->rows[row].fps);
        measured[rows] = log(1000 / cell->frame_ms.median);
        for (int other = 0; other < rows; other++)
            if ((published[other] < published[rows]) != (measured[other] < measured[rows]))
                shape.same_ranking = false;
    }
    if (rows < 2)
        return shape;
    shape.slope = rg_slope(axis, measured, rows);
    shape.published_slope = rg_slope(axis, published, rows);
    shape.verdict = !shape.same_ranking                                       ? RG_SHAPE_NOT
                    : fabs(shape.slope - shape.published_slope) <= SAME_SLOPE ? RG_SHAPE_REPRODUCED
                                                                              : RG_SHAPE_TREND;
    return shape;
}
