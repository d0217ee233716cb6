// How long tables are expected to take, before they are measured.
#ifndef RG_HARNESS_TABLES_RUNS_FORECAST_H
#define RG_HARNESS_TABLES_RUNS_FORECAST_H

#include "harness/devices/kept.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/papers/published.h"

// Whether so many cells take so long that it is worth opening some of them first.
bool rg_forecast_is_worth(int cells, bool full);

// What is asked for of a table, and what its rows' cells are expected to take.
struct rg_forecast {
    const struct rg_table *table;
    struct rg_table_part part;
    bool rows[RG_TABLE_ROWS];                 // of it, that are not there yet
    struct rg_cell_time times[RG_TABLE_ROWS]; // on average over works and devices
};

// Opens the rows of each table on cpu, in its first variant and work, and one in each work and on
// other devices, and fills in what their cells are expected to take. Of what cannot be opened,
// cells end at once.
void rg_forecast(struct rg_forecast *forecasts, int count, struct rg_kept *kept);

#endif
