// What a budget chose of tables, and what it left out, in lines for a user.
#ifndef RG_HARNESS_TABLES_RUNS_TELL_H
#define RG_HARNESS_TABLES_RUNS_TELL_H

#include <stdio.h>

#include "harness/tables/runs/chosen.h"

// The rows of a table that are chosen.
void rg_budget_rows(const struct rg_budget *budget, int table, bool rows[RG_TABLE_ROWS]);
// What its width and height are divided by: 1, 2 or 4.
int rg_budget_divisor(const struct rg_budget_choice *choice);
// The seconds that the least of a table would take that is worth having.
double rg_budget_least_s(const struct rg_budget *budget, int table);

// Print what is planned of a table, and of all; and in the end what was left out, and what all took
// beside what was planned.
void rg_budget_tell_table(const struct rg_budget *budget, int table, FILE *out);
void rg_budget_tell(const struct rg_budget *budget, FILE *out);
void rg_budget_tell_end(const struct rg_budget *budget, double taken_s, FILE *out);

#endif
