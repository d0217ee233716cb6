// Which shard of a plan a command measures, and measuring it.
#ifndef RG_HARNESS_COMMANDS_TABLES_PLAN_SHARD_H
#define RG_HARNESS_COMMANDS_TABLES_PLAN_SHARD_H

#include "harness/commands/cli/shard.h"
#include "harness/tables/farm/plan.h"

struct rg_shard_asked {
    char *plan;    // a file; NULL: none is measured
    char *shard;   // "2/8" or "auto"; NULL: all of the plan
    char *folder;  // of its records; NULL: not given
    int timeout_s; // of devices
};

// Finds the shard of a plan that was asked for (rg_shard_read). NULL is all. False, with one logged
// line, where it is none of the plan's.
bool rg_shard_find(const struct rg_farm_plan *plan, const char *asked, struct rg_shard *shard);

// Measures a shard of a plan. Returns an enum rg_exit.
int rg_shard_run(const struct rg_shard_asked *asked);

#endif
