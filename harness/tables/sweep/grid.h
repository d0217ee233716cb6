// A table that nobody wrote: a row for each combination of the values of some axes.
#ifndef RG_HARNESS_TABLES_SWEEP_GRID_H
#define RG_HARNESS_TABLES_SWEEP_GRID_H

#include "harness/record/result.h"
#include "harness/tables/sweep/axis.h"

enum { RG_GRID_AXES = 8 };

struct rg_grid {
    int axis_count;
    struct rg_axis axes[RG_GRID_AXES]; // the first goes slowest
    // What the table points to, and the table.
    char id[RG_NAME_SIZE], note[RG_NOTE_SIZE], sets[RG_TABLE_ROWS][RG_SET_SIZE];
    struct rg_table_row rows[RG_TABLE_ROWS];
    struct rg_table table;
};

// Makes the table of a technique with a zeroed grid's axes. It points into the grid. Each row must
// be settings that the technique takes. False, and one logged line, where there are too many, or
// one is refused.
bool rg_grid_make(struct rg_grid *grid, const struct rg_technique *technique);
// Whether each row of a grid that is made keeps its values of the axes under these "key=value",
// which are over all rows. False, and one logged line, where one changes an axis, by itself or as a
// preset.
bool rg_grid_keeps_axes(const struct rg_grid *grid, const struct rg_technique *technique,
                        const char *const *sets, int count);

#endif
