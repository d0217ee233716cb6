#include "harness/table.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/alloc.h"
#include "core/image/compare.h"
#include "core/log.h"
#include "harness/frame.h"
#include "harness/progress.h"

static const struct rg_measure_options quick = {.samples = 15, .sample_ms = 15};
static const struct rg_measure_options full = {.samples = 61, .sample_ms = 60};

struct rg_table_group *rg_table_group(const struct rg_table_run *run, int row, int variant)
{
    return &run->groups[(row - run->first_row) * rg_table_variant_count(run->table) + variant];
}

struct rg_cell *rg_table_cell(const struct rg_table_run *run, int row, int variant, int device)
{
    const long group = rg_table_group(run, row, variant) - run->groups;
    return &run->cells[group * run->devices->count + device];
}

double rg_cell_fps(const struct rg_cell *cell)
{
    return 1000 / cell->frame_ms.median;
}

double rg_table_published_fps(const struct rg_table *table, int row, int variant)
{
    return rg_table_is_published(table) ? rg_table_value(table, row, table->variants[variant].fps)
                                        : NAN;
}

static bool make_settings(const struct rg_table_run *run, int row, int variant,
                          const struct rg_technique *technique, void **settings)
{
    void *defaults = rg_settings_create(technique);
    void *of_row =
        defaults ? rg_settings_copy(technique, defaults, run->table->rows[row].set) : NULL;
    *settings =
        of_row ? rg_settings_copy(technique, of_row, run->table->variants[variant].set) : NULL;
    free(of_row);
    free(defaults);
    return *settings != NULL;
}

static bool needs_dry(const struct rg_table_run *run)
{
    bool needed = run->table->truth != NULL;
    for (int d = 0; d < run->devices->count; d++)
        needed = needed || !run->devices->devices[d]->info.software;
    return needed;
}

// How far the expected image is from the table's truth, which `cpu` draws: it may be a slow one.
static bool measure_error(const struct rg_table *table, const struct rg_technique *technique,
                          const struct rg_expected *expected, struct rg_table_group *group)
{
    void *settings = rg_settings_copy(technique, group->settings, table->truth);
    struct rg_device *device = settings ? rg_device_open("cpu", NULL) : NULL;
    struct rg_picture truth = {0};
    struct rg_comparison c = {0};
    const bool ok = device &&
                    rg_frame_draw(technique, settings, device, table->width, table->height,
                                  RG_CHECK_FRAMES, &truth) &&
                    rg_compare(&truth, "the truth", &expected->picture, table->id, &expected->dry,
                               &(struct rg_compare_options){0}, &c);
    group->has_error = ok;
    group->error = (struct rg_table_error){c.flip.mask_mean, c.flip.mean, c.tiers.max_codes};
    rg_comparison_destroy(&c);
    rg_picture_destroy(&truth);
    free(settings);
    return rg_device_close(device) && ok;
}

static void prepare_group(struct rg_table_run *run, int row, int variant,
                          struct rg_progress *progress)
{
    const struct rg_table *table = run->table;
    const struct rg_technique *technique = rg_technique_find(table->technique);
    struct rg_table_group *group = rg_table_group(run, row, variant);
    struct rg_expected expected = {0};
    const bool ok = make_settings(run, row, variant, technique, &group->settings) &&
                    rg_expected_make(&expected, technique, group->settings, table->width,
                                     table->height, needs_dry(run)) &&
                    (!table->truth || measure_error(table, technique, &expected, group));
    char why[160] = "";
    if (!ok)
        snprintf(why, sizeof(why), "%s", rg_last_error());
    for (int d = 0; d < run->devices->count; d++) {
        struct rg_cell *cell = rg_table_cell(run, row, variant, d);
        *cell = (struct rg_cell){.technique = technique,
                                 .settings = group->settings,
                                 .device = run->devices->devices[d],
                                 .width = table->width,
                                 .height = table->height,
                                 .status = RG_CELL_ERROR};
        if (ok)
            rg_cell_prepare(cell, &expected);
        else
            snprintf(cell->detail, sizeof(cell->detail), "no image to check it by: %s", why);
        rg_progress_add(progress, 1);
    }
    rg_expected_free(&expected);
}

static void show_round(int done, int total, void *user)
{
    (void)done;
    (void)total;
    rg_progress_add(user, 1);
}

bool rg_table_measure(struct rg_table_run *run)
{
    const int variants = rg_table_variant_count(run->table);
    const int groups = (run->last_row - run->first_row + 1) * variants;
    const int cells = groups * run->devices->count;
    struct rg_measure_options options = run->full ? full : quick;
    run->cells = rg_alloc((size_t)cells, sizeof(*run->cells), run->table->id);
    run->groups = rg_alloc((size_t)groups, sizeof(*run->groups), run->table->id);
    if (!run->cells || !run->groups)
        return false;
    run->cell_count = cells;
    run->samples = options.samples;
    struct rg_progress progress;
    rg_progress_start(&progress, run->cell_count + options.samples);
    rg_progress_label(&progress, "%s", run->table->id);
    for (int row = run->first_row; row <= run->last_row; row++)
        for (int variant = 0; variant < variants; variant++)
            prepare_group(run, row, variant, &progress);
    options.progress = show_round;
    options.user = &progress;
    rg_cells_measure(run->cells, run->cell_count, &options);
    rg_progress_end(&progress);
    return true;
}

void rg_table_run_free(struct rg_table_run *run)
{
    for (int i = 0; i < run->cell_count; i++)
        rg_cell_close(&run->cells[i]);
    for (int i = 0; i < run->cell_count / run->devices->count; i++)
        free(run->groups[i].settings);
    free(run->groups);
    free(run->cells);
}
