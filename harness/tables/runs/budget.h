// Measures tables within a time budget: cells in order of priority (order.h) until time is over.
#ifndef RG_HARNESS_TABLES_RUNS_BUDGET_H
#define RG_HARNESS_TABLES_RUNS_BUDGET_H

#include "harness/tables/runs/regenerate.h"

// Measures as much as fits into options->budget_s, which began at options->begin_ms. Then prints
// each table that has a row, and to `out` the parts that were left out. A cell does not begin if it
// would end after the budget, judged by its own and its neighbours' earlier times; a cell without
// such times does. If not even the first row fits, logs how long it takes, and prints nothing.
// There is no journal. Returns an enum rg_exit.
int rg_tables_within(const struct rg_table *const tables[], int count,
                     const struct rg_devices *devices, const struct rg_regenerate_options *options,
                     FILE *out);

#endif
