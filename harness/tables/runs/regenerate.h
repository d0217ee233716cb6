// Regenerates a command's tables one after the other.
#ifndef RG_HARNESS_TABLES_RUNS_REGENERATE_H
#define RG_HARNESS_TABLES_RUNS_REGENERATE_H

#include "harness/tables/table.h"

struct rg_regenerate_options {
    int first_row, last_row; // from 1; 0: all. A table with fewer rows gives those that it has
    bool full, fresh;
    // Measures what claims need, each cell with few samples, and then launches until the claims are
    // decided, or `budget_s` is over.
    bool decides;
    int launches;               // of each cell, after it was measured
    const char *work, *variant; // NULL: all
    const char *set;            // over the settings of all cells, as in struct rg_table_part
    double budget_s;            // limit for all tables together, without journals; 0: no limit
    double begin_ms;            // by rg_now_ms, when the budget began
    const char *folder; // for results and journals; NULL: journals go to the user's state folder
    // Prints a table's result, which may be incomplete after an interruption, and returns its exit
    // status (harness/console/exit.h).
    int (*print)(const struct rg_result *result, const void *user);
    // Prints the text after all tables, before their journals are removed; NULL: none.
    int (*print_end)(const void *user);
    const void *user;
};

// Measures and prints each table; a failure does not stop the others. Returns an enum rg_exit.
int rg_tables_regenerate(const struct rg_table *const tables[], int count,
                         const struct rg_devices *devices,
                         const struct rg_regenerate_options *options);

#endif
