// Cuts a plan into shards of about the same expected time.
#ifndef RG_HARNESS_TABLES_FARM_CUT_H
#define RG_HARNESS_TABLES_FARM_CUT_H

#include "harness/tables/farm/plan.h"

struct rg_farm_shard {
    int number, count; // from 1
};

// Gives each group a shard: the largest first, each to the shard with the least so far. The same
// plan is always cut the same way. `shard_of` has room for all groups, and gets numbers from 1.
// `seconds` gets the longest shard's; may be NULL. False, with one logged line, when memory runs
// out.
bool rg_farm_cut(const struct rg_farm_plan *plan, int shards, int *shard_of, double *seconds);

// Writes numbers from 1 as `sbatch --array` takes them: "2,5-7"; "" for none. `has` says it of each
// of `count` numbers, the first at 0. RG_FARM_NUMBER bytes a number are enough.
enum { RG_FARM_NUMBER = 12 };
void rg_farm_array(const bool *has, int count, char *text, size_t size);

#endif
