// Regenerating tables one after the other, as the command asks for them.
#ifndef RG_HARNESS_TABLES_RUNS_REGENERATE_H
#define RG_HARNESS_TABLES_RUNS_REGENERATE_H

#include "harness/tables/table.h"

struct rg_regenerate_options {
    int first_row, last_row; // from 1; 0: all. A table without some of them gives what it has
    bool full, fresh;
    const char *work, *variant; // NULL: all
    const char *set;            // over the settings of all cells, as struct rg_table_part has it
    double budget_s;    // what all tables may take together, without journals; 0: all they need
    double begin_ms;    // by rg_now_ms, when the budget began
    const char *folder; // of the results, which journals lie beside; NULL: the user's state
    // Prints what there is of a table, which may be interrupted, and returns how that ended
    // (harness/console/exit.h).
    int (*print)(const struct rg_result *result, const void *user);
    // Prints what stands behind all tables, before their journals go; NULL: nothing does.
    int (*print_end)(const void *user);
    const void *user;
};

// Measures and prints each; one that fails keeps none of the others from it. Returns an enum
// rg_exit.
int rg_tables_regenerate(const struct rg_table *const tables[], int count,
                         const struct rg_devices *devices,
                         const struct rg_regenerate_options *options);

#endif
