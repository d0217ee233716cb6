#include "harness/commands/tables/shard.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/record/output.h"
#include "harness/record/passport/build_info.h"
#include "harness/tables/farm/shard.h"
#include "harness/tables/papers/papers.h"

// --- which shard ---

// A whole number from 0 on in a variable. False, with one logged line, where it is none.
static bool read_variable(const char *name, const char *text, int *number)
{
    char *end;
    const long value = text ? strtol(text, &end, 10) : -1;
    *number = (int)value;
    return (text && end != text && !*end && value >= 0 && value <= INT_MAX) ||
           rg_error("--shard auto: %s '%.40s' is no whole number from 0 on; write --shard 1/4",
                    name, text ? text : "");
}

// The numbers of a plan that says how many shards there are are those of the array; else the array
// has to be without a gap, for a task does not know of others'.
static bool read_slurm(const struct rg_farm_plan *plan, struct rg_farm_shard *shard)
{
    int id, first, last, count;
    if (!read_variable("SLURM_ARRAY_TASK_ID", getenv("SLURM_ARRAY_TASK_ID"), &id) ||
        !read_variable("SLURM_ARRAY_TASK_MIN", getenv("SLURM_ARRAY_TASK_MIN"), &first) ||
        !read_variable("SLURM_ARRAY_TASK_MAX", getenv("SLURM_ARRAY_TASK_MAX"), &last) ||
        !read_variable("SLURM_ARRAY_TASK_COUNT", getenv("SLURM_ARRAY_TASK_COUNT"), &count))
        return false;
    *shard = plan->shards ? (struct rg_farm_shard){id, plan->shards}
                          : (struct rg_farm_shard){id - first + 1, count};
    return plan->shards || last - first + 1 == count ||
           rg_error("--shard auto: Slurm's array has gaps, and the plan does not say how many "
                    "shards there are; make it with `raingauge plan --shards N`");
}

static bool read_ci(struct rg_farm_shard *shard)
{
    return read_variable("CI_NODE_INDEX", getenv("CI_NODE_INDEX"), &shard->number) &&
           read_variable("CI_NODE_TOTAL", getenv("CI_NODE_TOTAL"), &shard->count);
}

static bool read_gtest(struct rg_farm_shard *shard)
{
    struct rg_gtest_shards shards;
    if (!rg_gtest_shards(&shards))
        return false;
    *shard = (struct rg_farm_shard){shards.index + 1, shards.total};
    return true;
}

static bool read_auto(const struct rg_farm_plan *plan, struct rg_farm_shard *shard)
{
    if (getenv("SLURM_ARRAY_TASK_ID"))
        return read_slurm(plan, shard);
    if (getenv("CI_NODE_INDEX") || getenv("CI_NODE_TOTAL"))
        return read_ci(shard);
    if (getenv("GTEST_TOTAL_SHARDS") || getenv("GTEST_SHARD_INDEX"))
        return read_gtest(shard);
    return rg_error("--shard auto: neither SLURM_ARRAY_TASK_ID, CI_NODE_INDEX nor "
                    "GTEST_SHARD_INDEX is set; write --shard 1/4");
}

static bool read_pair(const char *text, struct rg_farm_shard *shard)
{
    char end;
    return sscanf(text, "%9d/%9d%c", &shard->number, &shard->count, &end) == 2 ||
           rg_error("--shard %.40s: write it as 1/4, the first of four, or as auto", text);
}

bool rg_shard_find(const struct rg_farm_plan *plan, const char *asked, struct rg_farm_shard *shard)
{
    *shard = (struct rg_farm_shard){1, 1};
    if (!asked)
        return plan->shards <= 1 || rg_error("--plan: the plan is cut into %d shards; name one, as "
                                             "--shard 1/%d, or --shard auto",
                                             plan->shards, plan->shards);
    if (!(strcmp(asked, "auto") ? read_pair(asked, shard) : read_auto(plan, shard)))
        return false;
    if (plan->shards && shard->count != plan->shards)
        return rg_error("--shard %.40s: there are %d, and the plan is cut into %d; use as many, or "
                        "plan anew",
                        asked, shard->count, plan->shards);
    return (shard->number >= 1 && shard->number <= shard->count) ||
           rg_error("--shard %.40s: shard %d is none of 1 to %d", asked, shard->number,
                    shard->count);
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

static int measure(const struct rg_farm_plan *plan, const struct rg_farm_shard *shard,
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
    struct rg_farm_shard shard;
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
