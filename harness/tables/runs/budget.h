// Tables within a budget of time: cells are measured in an order of priority (order.h) until the
// time is over.
#ifndef RG_HARNESS_TABLES_RUNS_BUDGET_H
#define RG_HARNESS_TABLES_RUNS_BUDGET_H

#include "harness/tables/runs/regenerate.h"

// Measures what fits into options->budget_s, which began at options->begin_ms; then prints each
// table of which there is a row, and to `out` what was left out. A cell that would end behind the
// budget, by what it or its neighbours took, is not begun; one of which nothing is known is. Where
// not even the first row fits, one logged line says how long it takes, and nothing is printed.
// There is no journal. Returns an enum rg_exit.
int rg_tables_within(const struct rg_table *const tables[], int count,
                     const struct rg_devices *devices, const struct rg_regenerate_options *options,
                     FILE *out);

#endif
