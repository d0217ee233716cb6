// What comes before a row's cells are timed: the image that they must show, its distance from the
// truth, and the cells themselves; and rows that are about textures.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "harness/console/interrupt.h"
#include "harness/frames/frame.h"
#include "harness/tables/table.h"

// A row's variant, while its cells are prepared.
struct preparation {
    struct rg_table_run *run;
    struct rg_kept *kept;
    const struct rg_table *table;
    const struct rg_technique *technique;
    struct rg_table_group *group;
    struct rg_cell *cells; // one a device
    struct rg_expected expected;
    int check_frames;
};

static bool make_settings(struct preparation *p, int row, int variant)
{
    void *defaults = rg_settings_create(p->technique);
    char *assignments = rg_table_assignments(p->run, row, variant);
    if (defaults && assignments)
        p->group->settings = rg_settings_copy(p->technique, defaults, assignments);
    free(assignments);
    free(defaults);
    return p->group->settings != NULL;
}

static void begin_cells(struct preparation *p)
{
    for (int d = 0; d < p->run->devices->count; d++)
        p->cells[d] = (struct rg_cell){.technique = p->technique,
                                       .settings = p->group->settings,
                                       .device = p->run->devices->devices[d],
                                       .width = p->table->width,
                                       .height = p->table->height,
                                       .check_frames = p->check_frames,
                                       .status = RG_OK};
}

// --- the image ---

// The background is what a mask of rain is made from: for the distance from the truth, and for
// devices that are held to tier T1.
static bool needs_dry(const struct rg_table_run *run)
{
    bool needed = run->table->truth != NULL;
    for (int d = 0; d < run->devices->count; d++)
        needed = needed || !run->devices->devices[d]->info.software;
    return needed;
}

// What cpu:reference shows: as a cell of the table, where it is one, else aside.
static bool draw_expected(struct preparation *p)
{
    struct rg_device *device = rg_kept_device(p->kept, "cpu:reference");
    for (int d = 0; device && d < p->run->devices->count; d++)
        if (p->cells[d].device == device)
            return rg_cell_open(&p->cells[d]) &&
                   rg_expected_read(&p->expected, p->cells[d].instance);
    struct rg_instance *instance =
        device ? rg_frame_run(p->technique, p->group->settings, device, p->table->width,
                              p->table->height, p->check_frames)
               : NULL;
    if (!instance)
        return false;
    const bool ok = rg_expected_read(&p->expected, instance);
    rg_kept_put(p->kept, instance);
    return ok;
}

static bool draw_dry(struct preparation *p)
{
    return !needs_dry(p->run) ||
           rg_frame_draw_dry(p->technique, p->group->settings,
                             rg_kept_device(p->kept, "cpu:reference"), p->table->width,
                             p->table->height, p->check_frames, &p->expected.dry);
}

static bool compare_with_truth(struct preparation *p, const void *settings)
{
    const struct rg_subject subject = {p->technique, settings, p->table->width, p->table->height};
    const struct rg_picture *truth = rg_kept_truth(p->kept, &subject, p->check_frames);
    struct rg_comparison c = {0};
    const bool ok = truth && rg_compare(truth, "the truth", &p->expected.picture, p->table->id,
                                        &p->expected.dry, &(struct rg_compare_options){0}, &c);
    p->group->error = (struct rg_table_error){c.flip.mask_mean, c.flip.mean, c.tiers.max_codes};
    rg_comparison_destroy(&c);
    return ok;
}

// How far the expected image is from the table's truth. Cells are timed without it, too.
static void measure_error(struct preparation *p)
{
    if (!p->table->truth || rg_interrupted())
        return;
    void *settings = rg_settings_copy(p->technique, p->group->settings, p->table->truth);
    if (!settings || !compare_with_truth(p, settings)) {
        p->group->error_status = rg_outcome_of_error();
        snprintf(p->group->error_detail, sizeof(p->group->error_detail), "%s", rg_last_error());
    }
    free(settings);
}

// --- the cells ---

// Ends the cells that are not open, which nothing can be compared with.
static void give_up(struct preparation *p)
{
    const enum rg_outcome status = rg_outcome_of_error();
    char why[200];
    snprintf(why, sizeof(why), "no image to check it by: %.160s", rg_last_error());
    for (int d = 0; d < p->run->devices->count; d++)
        if (p->cells[d].status == RG_OK)
            rg_cell_end(&p->cells[d], status, why);
    p->group->error_status = status;
    snprintf(p->group->error_detail, sizeof(p->group->error_detail), "%s", why);
}

static void prepare_cells(struct preparation *p, const struct rg_measure_options *options)
{
    for (int d = 0; d < p->run->devices->count && !rg_interrupted(); d++) {
        struct rg_cell *cell = &p->cells[d];
        const bool is_open = cell->instance != NULL; // it made what is expected
        if (is_open || (rg_cell_open(cell) && rg_cell_check(cell, &p->expected)))
            rg_cell_warm_up(cell, options);
    }
}

static struct preparation begin(struct rg_table_run *run, struct rg_kept *kept, int row,
                                int variant)
{
    const struct rg_table *table = run->table;
    return (struct preparation){.run = run,
                                .kept = kept,
                                .table = table,
                                .technique = rg_technique_find(table->technique),
                                .group = rg_table_group(run, row, variant),
                                .cells = rg_table_cell(run, row, variant, 0),
                                .check_frames =
                                    table->check_frames ? table->check_frames : RG_CHECK_FRAMES};
}

void rg_table_prepare(struct rg_table_run *run, struct rg_kept *kept, int row, int variant,
                      const struct rg_measure_options *options)
{
    struct preparation p = begin(run, kept, row, variant);
    const bool has_settings = make_settings(&p, row, variant);
    begin_cells(&p);
    if (has_settings && draw_expected(&p) && draw_dry(&p)) {
        measure_error(&p);
        prepare_cells(&p, options);
    } else {
        give_up(&p);
    }
    rg_expected_free(&p.expected);
}

// --- rows that are about textures ---

static const struct rg_texture *find_texture(const struct rg_instance *instance, const char *name)
{
    for (int i = 0; i < instance->texture_count; i++)
        if (!strcmp(instance->textures[i].name, name))
            return &instance->textures[i];
    return NULL;
}

static void tell(struct rg_cell *cell, const char *name, int number)
{
    cell->facts[cell->fact_count++] = (struct rg_fact){.name = name, .number = number};
}

static bool tell_size(struct rg_cell *cell, const struct rg_instance *instance, const char *name,
                      int level)
{
    const struct rg_texture *texture = find_texture(instance, name);
    char why[200];
    if (!texture) {
        snprintf(why, sizeof(why), "%s has no texture '%s'", cell->technique->name, name);
        return rg_cell_end(cell, RG_ERROR, why);
    }
    const struct rg_image_desc *desc = &texture->image->desc;
    const int own_level = level - texture->first_level;
    if (own_level < 0) {
        snprintf(why, sizeof(why), "the texture is reduced, and begins with level %d",
                 texture->first_level);
        return rg_cell_end(cell, RG_UNSUPPORTED, why);
    }
    if (own_level >= desc->levels) {
        snprintf(why, sizeof(why), "the texture ends with level %d",
                 texture->first_level + desc->levels - 1);
        return rg_cell_end(cell, RG_FAIL, why);
    }
    tell(cell, "width_px", rg_level_size(desc->width, own_level));
    tell(cell, "height_px", rg_level_size(desc->height, own_level));
    return true;
}

void rg_table_tell_texture(struct rg_table_run *run, struct rg_kept *kept, int row, int variant)
{
    struct preparation p = begin(run, kept, row, variant);
    const bool has_settings = make_settings(&p, row, variant);
    const struct rg_subject subject = {p.technique, p.group->settings, p.table->width,
                                       p.table->height};
    begin_cells(&p);
    for (int d = 0; d < run->devices->count; d++) {
        struct rg_instance *instance =
            has_settings ? rg_kept_open(kept, p.cells[d].device, &subject) : NULL;
        if (instance)
            tell_size(&p.cells[d], instance, p.table->rows[row].name,
                      (int)rg_table_value(p.table, row, "level"));
        else
            rg_cell_end_by_error(&p.cells[d]);
    }
}
