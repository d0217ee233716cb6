// One regenerated table: measuring its cells, and what is said of them.
#ifndef RG_HARNESS_TABLE_H
#define RG_HARNESS_TABLE_H

#include <jansson.h>

#include "harness/command.h"
#include "harness/devices.h"
#include "harness/grid.h"
#include "harness/measure.h"
#include "harness/tables/tables.h"

// The cells of rows first_row..last_row (from 0) of a table on some devices, row by row.
struct rg_table_run {
    const struct rg_table *table;
    const struct rg_devices *devices;
    int first_row, last_row;
    bool full;
    int cell_count;
    struct rg_cell *cells;
    void **settings; // one a row
};

// Prepares and measures; false, with one logged line, when the reference itself cannot be had. The
// caller calls rg_table_run_free in either case.
bool rg_table_measure(struct rg_table_run *run);
void rg_table_run_free(struct rg_table_run *run);

// The cell of a row and a device, and its row.
const struct rg_cell *rg_table_cell(const struct rg_table_run *run, int row, int device);

// Whether a device's numbers fall as the published ones do.
enum rg_shape_verdict { RG_SHAPE_REPRODUCED, RG_SHAPE_TREND, RG_SHAPE_NOT, RG_SHAPE_UNKNOWN };
struct rg_shape {
    enum rg_shape_verdict verdict;
    bool same_ranking;
    double slope, published_slope; // of log(fps) over log(axis)
};
const char *rg_shape_verdict_text(enum rg_shape_verdict verdict);
struct rg_shape rg_table_shape(const struct rg_table_run *run, int device);

// The machine form (docs/records.md); the caller owns it.
json_t *rg_table_json(const struct rg_table_run *run);
// The table for people, in `grid`, which is zeroed before.
void rg_table_grid(const struct rg_table_run *run, struct rg_grid *grid);

#endif
