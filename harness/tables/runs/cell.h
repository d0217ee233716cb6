// What a cell of a table is expected to take, by what its frames take.
#ifndef RG_HARNESS_TABLES_RUNS_CELL_H
#define RG_HARNESS_TABLES_RUNS_CELL_H

#include "harness/measure/job.h"
#include "harness/tables/papers/published.h"

// The frames before its image is compared.
int rg_budget_check_frames(const struct rg_table *table);

// What a cell takes, in milliseconds: opening, the frames before its image is compared, warming up,
// samples with a frame before each, and the passes told apart.
double rg_budget_cell_ms(const struct rg_table *table, double open_ms, double frame_ms,
                         const struct rg_measure_options *options);

// What comparing pictures takes, in milliseconds a pixel, by comparing some of noise now: FLIP
// takes the same for all pictures.
double rg_budget_compare_ms(void);

#endif
