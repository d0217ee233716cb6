// Makes a table for a sweep: one row per combination of values of the axes.
#ifndef RG_HARNESS_TABLES_OWN_GRID_H
#define RG_HARNESS_TABLES_OWN_GRID_H

#include "harness/record/result.h"
#include "harness/tables/own/axis.h"

enum { RG_GRID_AXES = 8 };

struct rg_grid {
    int axis_count;
    struct rg_axis axes[RG_GRID_AXES]; // the first varies slowest
    bool is_listed;  // row n has the n-th value of each axis; false: rows are all combinations
    const char *set; // assignments before those of the axes; NULL: none
    // The table, and the memory to which it points.
    char id[RG_NAME_SIZE], note[RG_NOTE_SIZE], sets[RG_TABLE_ROWS][RG_SET_SIZE];
    struct rg_table_row rows[RG_TABLE_ROWS];
    struct rg_table table;
};

// Makes the table of a technique for the axes of a grid that is zeroed otherwise. The table points
// into the grid. False, and one logged line, if there are too many rows, or the technique refuses
// the settings of one.
bool rg_grid_make(struct rg_grid *grid, const struct rg_technique *technique);
// Whether each row of a finished grid keeps its values of the axes under these "key=value" sets,
// which apply over all rows. False, and one logged line, if one changes an axis, directly or as a
// preset.
bool rg_grid_keeps_axes(const struct rg_grid *grid, const struct rg_technique *technique,
                        const char *const *sets, int count);

#endif
