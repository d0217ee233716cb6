// Measures the groups of a plan's shard.
#ifndef RG_HARNESS_TABLES_FARM_GROUPS_H
#define RG_HARNESS_TABLES_FARM_GROUPS_H

#include "harness/devices/devices.h"
#include "harness/tables/farm/cut.h"
#include "harness/tables/papers/published.h"

// The table of a group's id; NULL: there is none.
typedef const struct rg_table *rg_farm_find(const char *id);

// Measures the groups of a shard, one after the other, and leaves a record of each in `folder`.
// Groups whose record is there are not measured again, so that a shard goes on where it ended.
// Prints a line for each group. Returns an enum rg_exit: the worst of all its records, or of an
// interruption, which loses the group under way.
int rg_farm_measure(const struct rg_farm_plan *plan, const struct rg_shard *shard,
                    const struct rg_devices *devices, rg_farm_find *find, const char *folder);

#endif
