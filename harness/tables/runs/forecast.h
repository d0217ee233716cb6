// How long tables are expected to take, before they are measured.
#ifndef RG_HARNESS_TABLES_RUNS_FORECAST_H
#define RG_HARNESS_TABLES_RUNS_FORECAST_H

#include "harness/devices/kept.h"
#include "harness/tables/papers/published.h"
#include "harness/tables/measuring/measure.h"

// Whether so many cells take so long that it is worth opening some of them first.
bool rg_forecast_is_worth(int cells, bool full);

// Opens a few cells of each table, and fills in what one is expected to take, on average over the
// devices. Of what cannot be opened, cells end at once.
void rg_forecast(const struct rg_table *const tables[], int count, struct rg_kept *kept, bool full,
                 struct rg_cell_time *times);

#endif
