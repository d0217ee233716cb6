// Tables within a budget of time: what of each is measured now, and what was left out.
#ifndef RG_HARNESS_TABLES_RUNS_BUDGET_H
#define RG_HARNESS_TABLES_RUNS_BUDGET_H

#include <stdio.h>

#include "harness/tables/runs/chosen.h"

// Probes the tables and prints the plan to `out`, a line a table. `kept` is of all devices. False,
// and one logged line, where there are too many tables.
bool rg_budget_begin(struct rg_budget *budget, const struct rg_table *const tables[], int count,
                     struct rg_kept *kept, double seconds, FILE *out);

// Begins the result of a table as the budget has it, after it has been planned anew, with those
// that follow, by the time that is left and by how long those before it took: budget->table and
// budget->chosen are what is measured. False where the table is left out.
bool rg_budget_next(struct rg_budget *budget, int table, struct rg_result *result, FILE *out);
// Tells it that the table is done.
void rg_budget_done(struct rg_budget *budget, int table, const struct rg_result *result,
                    double start_ms);

// Prints what was left out, and what all took beside what was planned. False, and one logged line
// that names the cheapest table, where nothing was measured.
bool rg_budget_end(const struct rg_budget *budget, FILE *out);

#endif
