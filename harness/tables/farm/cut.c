#include "harness/tables/farm/cut.h"

#include <stdlib.h>

#include "core/base/alloc.h"

bool rg_farm_cut(const struct rg_farm_plan *plan, int shards, int *shard_of, double *longest_s)
{
    double *seconds = rg_alloc((size_t)plan->group_count, sizeof(*seconds), "shards");
    for (int64_t g = 0; seconds && g < plan->group_count; g++)
        seconds[g] = plan->groups[g].seconds;
    const bool ok =
        seconds && rg_shard_cut(seconds, plan->group_count, shards, shard_of, longest_s);
    free(seconds);
    return ok;
}
