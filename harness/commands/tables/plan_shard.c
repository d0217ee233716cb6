#include "harness/commands/tables/plan_shard.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/record/output.h"
#include "harness/record/passport/build_info.h"
#include "harness/tables/farm/groups.h"
#include "harness/tables/papers/papers.h"

// --- which shard ---

bool rg_shard_find(const struct rg_farm_plan *plan, const char *asked, struct rg_shard *shard)
{
    *shard = (struct rg_shard){1, 1};
    if (!asked)
        return plan->shards <= 1 || rg_error("--plan: the plan is cut into %d shards; name one, as "
                                             "--shard 1/%d, or --shard auto",
                                             plan->shards, plan->shards);
    return rg_shard_read(asked, plan->shards, shard);
}

// --- measuring ---

// The plan's devices, as --device has them.
static bool name_devices(const struct rg_farm_plan *plan, char *names, size_t size)
{
    size_t used = 0;
    for (int d = 0; d < plan->device_count && used < size; d++)
        used += (size_t)snprintf(names + used, size - used, "%s%s", d ? "," : "",
                                 plan->devices[d].asked);
    return used < size || rg_error("--plan: the names of its devices are too long");
}

static int measure(const struct rg_farm_plan *plan, const struct rg_shard *shard,
                   const struct rg_shard_asked *asked)
{
    static char names[RG_MAX_DEVICES * RG_FARM_ASKED];
    struct rg_devices devices;
    if (!name_devices(plan, names, sizeof(names)) || !rg_output_folder(asked->folder))
        return rg_exit_of_error();
    const struct rg_devices_asked wanted = {.names = names, .timeout_s = asked->timeout_s};
    const int exit = rg_devices_open_asked(&wanted, &devices);
    if (exit != RG_EXIT_PASS)
        return exit;
    return rg_devices_end(&devices, rg_exit_worse(rg_farm_measure(plan, shard, &devices,
                                                                  rg_table_find, asked->folder),
                                                  rg_devices_exit(&devices)));
}

int rg_shard_run(const struct rg_shard_asked *asked)
{
    struct rg_farm_plan plan = {0};
    struct rg_shard shard;
    bool ok =
        (asked->folder || rg_error("--plan: name the folder of its records, as -o records")) &&
        rg_farm_plan_read(&plan, asked->plan) && rg_shard_find(&plan, asked->shard, &shard) &&
        rg_output_can_be_written(asked->folder, RG_OUTPUT_TABLE_BYTES);
    if (ok && strcmp(plan.commit, rg_build_commit) != 0)
        ok = rg_error("%s: is of commit %s, and this raingauge of %s; plan anew, or measure with "
                      "that one",
                      asked->plan, plan.commit, rg_build_commit);
    const int exit = ok ? measure(&plan, &shard, asked) : rg_exit_of_error();
    rg_farm_plan_free(&plan);
    return exit;
}
