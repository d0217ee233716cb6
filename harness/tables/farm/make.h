// Makes plans of tables.
#ifndef RG_HARNESS_TABLES_FARM_MAKE_H
#define RG_HARNESS_TABLES_FARM_MAKE_H

#include "harness/record/disk/stored.h"
#include "harness/tables/farm/plan.h"
#include "harness/tables/papers/published.h"

// Names the devices of a plan, as --device does. No device is opened, for the machine that plans
// may have none of them: "all" is refused. False, and one logged line, where a name is malformed.
bool rg_farm_name_devices(struct rg_farm_plan *plan, const char *names);

// Adds the cells of tables to a plan whose devices and length are set: the rows that `raingauge
// table` measures, each in all variants and all works that every device can do. False, with one
// logged line, when memory runs out.
bool rg_farm_make(struct rg_farm_plan *plan, const struct rg_table *const tables[], int count);

// Sets each cell's expected seconds: by its record in `stored`; else by those of its table on its
// device, of its table, of its device, or of any; else by how long the calibration load takes,
// `load_ms`. Returns the number of cells that are known by their records; -1, with one logged line,
// when memory runs out.
int64_t rg_farm_expect(struct rg_farm_plan *plan, const struct rg_table *const tables[], int count,
                       const struct rg_stored *stored, double load_ms);

#endif
