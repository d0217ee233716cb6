// Merges the records of a plan into tables.
#ifndef RG_HARNESS_TABLES_FARM_MERGE_H
#define RG_HARNESS_TABLES_FARM_MERGE_H

#include "harness/tables/farm/found.h"

// Writes the tables of a plan's records into a folder, as `raingauge table -o` does, one table at a
// time. Where records have several comparison keys each has a folder of its own in it, with its own
// tables: no table has times of two keys. Prints a line for each folder. Returns an enum rg_exit:
// that of the cells.
int rg_farm_merge(const struct rg_farm_plan *plan, const struct rg_farm_records *found,
                  const char *folder);

#endif
