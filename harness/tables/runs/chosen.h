// What is known of the tables of a budget, and what of each was chosen.
#ifndef RG_HARNESS_TABLES_RUNS_CHOSEN_H
#define RG_HARNESS_TABLES_RUNS_CHOSEN_H

#include "harness/tables/runs/probe.h"
#include "harness/tables/table.h"

enum { RG_BUDGET_TABLES = 64 };

// Begun by rg_budget_begin; what a choice points to lives as long as this.
struct rg_budget {
    const struct rg_table *const *tables;
    int count;
    const struct rg_devices *devices; // all that are given
    double seconds, start_ms;
    double probed_s, planned_s;    // what probing took; what is planned behind it
    int measured;                  // tables of which there are rows
    double due_s, taken_s;         // what tables that are done were to take, and took
    struct rg_budget_devices bits; // cpu comes first, and cpu:reference last
    struct rg_budget_kind kinds[RG_BUDGET_TABLES]; // at the first table of each technique
    struct rg_budget_table costs[RG_BUDGET_TABLES];
    struct rg_budget_choice choices[RG_BUDGET_TABLES];
    // Of the table that is measured now.
    struct rg_table table;
    char *quick; // owned; of the table
    struct rg_devices chosen;
};

#endif
