// Rows and axes in a table's file.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/tables/own/reading.h"

// --- words ---

char *rg_own_behind(char *text)
{
    char *bar = strchr(text, '|');
    if (!bar)
        return NULL;
    for (char *end = bar; end >= text && strchr("| \t", *end); end--)
        *end = 0;
    return rg_line_skip(bar + 1);
}

bool rg_own_pair(char **rest, char **key, char **value)
{
    *key = *rest;
    *rest = rg_line_cut(*rest);
    char *sign = strchr(*key, '=');
    if (!sign || sign == *key)
        return rg_error("'%.80s': write it as KEY=VALUE", *key);
    *sign = 0;
    *value = sign + 1;
    return true;
}

bool rg_own_number(const char *key, const char *text, double *number)
{
    char *end;
    *number = strtod(text, &end);
    return (end != text && !*end && isfinite(*number)) ||
           rg_error("%.80s=%.80s: is no number", key, text);
}

int rg_own_rows(const struct rg_own *own)
{
    int rows = own->grid.axis_count > 0;
    for (int i = 0; i < own->grid.axis_count; i++)
        rows = own->grid.is_listed ? own->grid.axes[0].count : rows * own->grid.axes[i].count;
    return rows;
}

bool rg_own_has_variant(const struct rg_own *own, const char *name)
{
    for (int i = 0; i < own->variant_count; i++)
        if (!strcmp(own->table.variants[i].name, name))
            return true;
    return false;
}

bool rg_own_accepts(const struct rg_own *own, const char *assignments)
{
    void *settings = rg_settings_copy(own->technique, own->defaults, assignments);
    const bool ok = settings && strlen(assignments) < RG_SET_SIZE / 2;
    if (settings && !ok)
        rg_error("more than %d letters; leave some settings out", RG_SET_SIZE / 2 - 1);
    free(settings);
    return ok;
}

// --- rows ---

bool rg_own_take_axis(struct rg_own *own, char *text)
{
    struct rg_grid *grid = &own->grid;
    if (grid->is_listed)
        return rg_error("axis: rows stand before it; write one of the two");
    return (grid->axis_count < RG_GRID_AXES || rg_error("more than %d axes", RG_GRID_AXES)) &&
           rg_axis_read("axis", text, &grid->axes[grid->axis_count++]);
}

static struct rg_axis *axis_of(struct rg_grid *grid, const char *key)
{
    for (int i = 0; i < grid->axis_count; i++)
        if (!strcmp(grid->axes[i].name, key))
            return &grid->axes[i];
    return NULL;
}

// Adds a row's value of a parameter. The first row says which parameters rows have.
static bool add_value(struct rg_grid *grid, int row, const char *key, const char *value)
{
    struct rg_axis *axis = axis_of(grid, key);
    if (!axis && !row && grid->axis_count < RG_GRID_AXES) {
        axis = &grid->axes[grid->axis_count++];
        *axis = (struct rg_axis){.word = "row"};
        snprintf(axis->name, sizeof(axis->name), "%s", key);
    }
    if (!axis || axis->count != row)
        return rg_error("row: sets '%.80s' %s", key,
                        axis   ? "twice; take one out"
                        : !row ? "beside eight others; leave some out"
                               : "and the first row does not; name the same in all");
    if (strlen(value) >= RG_AXIS_VALUE)
        return rg_error("row: '%.80s' has more than %d letters", value, RG_AXIS_VALUE - 1);
    snprintf(axis->values[axis->count++], RG_AXIS_VALUE, "%s", value);
    return true;
}

// Adds what is printed of a row: "fps=87 faces=69666".
static bool add_printed(struct rg_own *own, int row, char *rest)
{
    char *key, *value;
    for (int c = 0; c < RG_TABLE_VALUES; c++)
        own->values[row][c] = NAN;
    while (rest && *rest) {
        int column = 0;
        if (!rg_own_pair(&rest, &key, &value))
            return false;
        while (column < own->printed_count && strcmp(own->printed[column], key) != 0)
            column++;
        if (column == own->printed_count && row)
            return rg_error("row: has '%.80s' printed and the first row has not; name the same in "
                            "all",
                            key);
        if (column == RG_TABLE_VALUES)
            return rg_error("row: more than %d printed values", RG_TABLE_VALUES);
        own->printed[column] = key;
        own->printed_count = column >= own->printed_count ? column + 1 : own->printed_count;
        if (!rg_own_number(key, value, &own->values[row][column]))
            return false;
    }
    return true;
}

bool rg_own_take_row(struct rg_own *own, char *text)
{
    struct rg_grid *grid = &own->grid;
    char *printed = rg_own_behind(text), *key, *value;
    const int row = grid->is_listed ? grid->axes[0].count : 0;
    if (grid->axis_count && !grid->is_listed)
        return rg_error("row: an axis stands before it; write one of the two");
    if (row == RG_TABLE_ROWS)
        return rg_error("more than %d rows; split the file", RG_TABLE_ROWS);
    if (!*text)
        return rg_error("row: sets no parameter; write KEY=VALUE, as in faces=10000");
    if (!rg_own_accepts(own, text))
        return false;
    grid->is_listed = true;
    while (*text)
        if (!rg_own_pair(&text, &key, &value) || !add_value(grid, row, key, value))
            return false;
    for (int i = 0; i < grid->axis_count; i++)
        if (grid->axes[i].count != row + 1)
            return rg_error("row: does not set '%s', and the first row does", grid->axes[i].name);
    return add_printed(own, row, printed);
}
