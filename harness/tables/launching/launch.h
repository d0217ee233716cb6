// One launch: a new process of a device, in which the cells that claims compare are timed in drawn
// order and back again.
#ifndef RG_HARNESS_TABLES_LAUNCHING_LAUNCH_H
#define RG_HARNESS_TABLES_LAUNCHING_LAUNCH_H

#include "harness/record/result.h"
#include "harness/tables/table.h"

enum { RG_LAUNCH_CELLS = RG_TABLE_ROWS * RG_TABLE_VARIANTS };

// The cells of a launch, by row and variant. Cells of one group are compared with each other, so
// that they are open at the same time; groups follow each other in drawn order.
struct rg_launch_cells {
    int count, group_count;
    struct rg_launch_cell {
        struct rg_place at;
        int group;
    } cells[RG_LAUNCH_CELLS];
};

// Takes launch `number` of a device of the result, whose records get it. False, and one logged
// line, if the device cannot be opened or a cell fails; its group then has no launch of this
// number. After an interruption the current group has none either.
bool rg_launch_take(struct rg_result *result, const struct rg_table *table,
                    const struct rg_launch_cells *cells, int number);

#endif
