// Regenerating a table: what its result says before and after it is measured.
#ifndef RG_HARNESS_TABLES_TABLE_H
#define RG_HARNESS_TABLES_TABLE_H

#include "harness/devices/kept.h"
#include "harness/record/result.h"
#include "harness/tables/papers/published.h"

// Which part of a table is measured.
struct rg_table_part {
    int first_row, last_row; // from 0
    bool full;
    const char *work;    // "paper", "ours" and so on; NULL: all, where a table tells them apart
    const char *variant; // NULL: all
    const char *set;     // over the settings of all cells, "key=value key=value"; NULL: nothing
};

// Fills a zeroed result with what the table, the part of it and the devices say, and no row.
void rg_table_begin(struct rg_result *result, const struct rg_table *table,
                    const struct rg_table_part *part, const struct rg_devices *devices);
// Adds a row whose records say what they are of, and nothing else. False, with one logged line,
// without memory for it.
bool rg_table_add_row(struct rg_result *result, const struct rg_table *table, int row);
// The work of a cell; one without a name where the table does not tell works apart.
const struct rg_table_work *rg_table_work_at(const struct rg_result *result,
                                             const struct rg_table *table, struct rg_place at);
// The assignments of a cell, over the technique's defaults. Owned by the caller; NULL, and one
// logged line, without memory.
char *rg_table_assignments(const struct rg_result *result, const struct rg_table *table,
                           struct rg_place at);
// The settings that they make. Owned by the caller; NULL, and one logged line, where one is
// refused.
void *rg_table_settings(const struct rg_result *result, const struct rg_table *table,
                        struct rg_place at);

#endif
