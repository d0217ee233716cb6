// Cuts a plan into shards of about the same expected time.
#ifndef RG_HARNESS_TABLES_FARM_CUT_H
#define RG_HARNESS_TABLES_FARM_CUT_H

#include "harness/record/shard.h"
#include "harness/tables/farm/plan.h"

// Gives each group of a plan a shard, as rg_shard_cut does. False, with one logged line, when
// memory runs out.
bool rg_farm_cut(const struct rg_farm_plan *plan, int shards, int *shard_of, double *longest_s);

#endif
