// Begins the result of a table: everything that is known before measuring.
#ifndef RG_HARNESS_TABLES_TABLE_H
#define RG_HARNESS_TABLES_TABLE_H

#include "harness/devices/kept.h"
#include "harness/record/result.h"
#include "harness/tables/papers/published.h"

// The part of a table that is measured.
struct rg_table_part {
    int first_row, last_row; // from 0
    bool full;
    const char *work;    // "paper", "ours" and so on; NULL: all, if the table distinguishes works
    const char *variant; // NULL: all
    const char *set;     // over the settings of all cells, "key=value key=value"; NULL: none
    bool is_everywhere;  // only works that every device can do
};

// Fills a zeroed result with the descriptions of the table, its part and the devices, without rows.
void rg_table_begin(struct rg_result *result, const struct rg_table *table,
                    const struct rg_table_part *part, const struct rg_devices *devices);
// Adds a row whose records are described but not measured. False, with one logged line, without
// memory for it.
bool rg_table_add_row(struct rg_result *result, const struct rg_table *table, int row);
// The work of a cell; it has no name if the table does not distinguish works.
const struct rg_table_work *rg_table_work_at(const struct rg_result *result,
                                             const struct rg_table *table, struct rg_place at);
// A cell's assignments, over the technique's defaults. Owned by the caller; NULL, and one logged
// line, without memory.
char *rg_table_assignments(const struct rg_result *result, const struct rg_table *table,
                           struct rg_place at);
// The settings from a cell's assignments. Owned by the caller; NULL, and one logged line, if one is
// refused.
void *rg_table_settings(const struct rg_result *result, const struct rg_table *table,
                        struct rg_place at);

#endif
