#include "harness/tables/own/grid.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/add.h"
#include "core/techniques/technique.h"

static const struct rg_param *param_of(const struct rg_technique *technique,
                                       const struct rg_axis *axis)
{
    return rg_params_find(technique->params, axis->name);
}

// Text parameters name the rows; numbers and choices have columns.
static bool has_column(const struct rg_technique *technique, const struct rg_axis *axis)
{
    const struct rg_param *param = param_of(technique, axis);
    return param && param->kind != RG_PARAM_FILE;
}

static bool add_columns(struct rg_grid *grid, const struct rg_technique *technique)
{
    struct rg_table *table = &grid->table;
    for (int i = 0; i < grid->axis_count; i++) {
        const struct rg_axis *axis = &grid->axes[i];
        for (int k = 0; k < i; k++)
            if (!strcmp(grid->axes[k].name, axis->name))
                return rg_error("%s %s: stands twice; name all its values at once", axis->word,
                                axis->name);
        // A preset has to be the first axis, because it overwrites parameters that are set before.
        if (i && technique->params->preset && !strcmp(axis->name, technique->params->preset))
            return rg_error("%s %s: stands for other parameters; name it before %s %s", axis->word,
                            axis->name, axis->word, grid->axes[0].name);
        if (has_column(technique, axis))
            table->columns[table->key_count++] = axis->name;
        else if (table->names)
            return rg_error("%s %s: only one can be of files, and %s is", axis->word, axis->name,
                            table->names);
        else
            table->names = axis->name;
    }
    return true;
}

static double value_of(const struct rg_param *param, const void *settings)
{
    const char *at = (const char *)settings + param->offset;
    return param->kind == RG_PARAM_FLOAT ? *(const double *)(const void *)at
                                         : *(const int *)(const void *)at;
}

// The index of a row's value on an axis; the last axis varies fastest.
static int index_at(const struct rg_grid *grid, int axis, int row)
{
    if (grid->is_listed)
        return row;
    for (int i = grid->axis_count - 1; i > axis; i--)
        row /= grid->axes[i].count;
    return row % grid->axes[axis].count;
}

static void write_set(struct rg_grid *grid, int row)
{
    char set[RG_SET_SIZE];
    snprintf(set, sizeof(set), "%s", grid->set ? grid->set : "");
    for (int i = 0; i < grid->axis_count; i++)
        rg_text_add(set, sizeof(set), " ", "%s=%s", grid->axes[i].name,
                    grid->axes[i].values[index_at(grid, i, row)]);
    memcpy(grid->sets[row], set, sizeof(set));
    grid->rows[row].set = grid->sets[row];
}

static bool make_row(struct rg_grid *grid, const struct rg_technique *technique, int row)
{
    void *defaults = rg_settings_create(technique), *settings = NULL;
    int column = 0;
    write_set(grid, row);
    if (defaults)
        settings = rg_settings_copy(technique, defaults, grid->sets[row]);
    for (int i = 0; settings && i < grid->axis_count; i++) {
        const struct rg_axis *axis = &grid->axes[i];
        if (has_column(technique, axis))
            grid->rows[row].values[column++] = value_of(param_of(technique, axis), settings);
        else
            grid->rows[row].name = axis->values[index_at(grid, i, row)];
    }
    const bool ok = settings != NULL;
    free(settings);
    free(defaults);
    return ok;
}

// The note names the axes, which distinguishes the journals of different sweeps.
static void write_note(struct rg_grid *grid)
{
    FILE *out = fmemopen(grid->note, sizeof(grid->note) - 1, "w");
    for (int i = 0; out && i < grid->axis_count; i++) {
        const struct rg_axis *axis = &grid->axes[i];
        fprintf(out, "%s%s=", i ? " and " : "A sweep: a row for each combination of ", axis->name);
        for (int k = 0; k < axis->count; k++)
            fprintf(out, "%s%s", k ? "," : "", axis->values[k]);
    }
    if (out) {
        fprintf(out, ", in their order.");
        fclose(out); // text that does not fit is cut
    }
}

bool rg_grid_make(struct rg_grid *grid, const struct rg_technique *technique)
{
    int64_t rows = 1;
    for (int i = 0; i < grid->axis_count; i++)
        rows = grid->is_listed ? grid->axes[i].count : rows * grid->axes[i].count;
    if (rows > RG_TABLE_ROWS)
        return rg_error("%s: %lld rows are more than %d; leave some values out", grid->axes[0].word,
                        (long long)rows, RG_TABLE_ROWS);
    snprintf(grid->id, sizeof(grid->id), "sweep-%s", technique->name);
    grid->table = (struct rg_table){.id = grid->id,
                                    .technique = technique->name,
                                    .about = "a sweep",
                                    .has_choices = true,
                                    .variants = {{"full", "", NULL}},
                                    .row_count = (int)rows,
                                    .rows = grid->rows,
                                    .note = grid->note};
    write_note(grid);
    bool ok = add_columns(grid, technique);
    for (int row = 0; ok && row < rows; row++)
        ok = make_row(grid, technique, row);
    return ok;
}

// The first axis whose value differs between two settings; NULL: none.
static const struct rg_axis *differing_axis(const struct rg_grid *grid,
                                            const struct rg_technique *technique,
                                            const void *settings, const void *others)
{
    char text[RG_PATH_SIZE], other[RG_PATH_SIZE];
    for (int i = 0; i < grid->axis_count; i++) {
        rg_params_text(param_of(technique, &grid->axes[i]), settings, text, sizeof(text));
        rg_params_text(param_of(technique, &grid->axes[i]), others, other, sizeof(other));
        if (strcmp(text, other) != 0)
            return &grid->axes[i];
    }
    return NULL;
}

// The options' sets apply over a row's settings, and may include a preset that changes others.
static bool keeps_row(const struct rg_grid *grid, const struct rg_technique *technique,
                      const void *settings, const char *const *sets, int count)
{
    for (int i = 0; i < count; i++) {
        void *changed = rg_settings_copy(technique, settings, sets[i]);
        const struct rg_axis *axis =
            changed ? differing_axis(grid, technique, settings, changed) : NULL;
        const bool ok = changed && !axis;
        free(changed);
        if (axis)
            return rg_error("--axis %s: --set %s would give all its rows one value; leave one of "
                            "the two out",
                            axis->name, sets[i]);
        if (!ok)
            return false;
    }
    return true;
}

bool rg_grid_keeps_axes(const struct rg_grid *grid, const struct rg_technique *technique,
                        const char *const *sets, int count)
{
    void *defaults = rg_settings_create(technique);
    bool ok = defaults;
    for (int row = 0; ok && row < grid->table.row_count; row++) {
        void *settings = rg_settings_copy(technique, defaults, grid->sets[row]);
        ok = settings && keeps_row(grid, technique, settings, sets, count);
        free(settings);
    }
    free(defaults);
    return ok;
}
