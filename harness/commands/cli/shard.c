#include "harness/commands/cli/shard.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/report/gtest.h"
#include "harness/console/exit.h"

const struct rg_option rg_shard_option[] = {
    {RG_OPTION_TEXT, "shard", .argument = "I/N|auto",
     .about = "runs only shard I of N, counted from 1; auto takes I and N from Slurm's variables, "
              "from CI_NODE_INDEX and CI_NODE_TOTAL, or from googletest's"},
    {RG_OPTION_END},
};

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

// The numbers of a whole whose shards are settled are those of the array; else the array has to be
// without a gap, for a task does not know of others'.
static bool read_slurm(int settled, struct rg_shard *shard)
{
    int id, first, last, count;
    if (!read_variable("SLURM_ARRAY_TASK_ID", getenv("SLURM_ARRAY_TASK_ID"), &id) ||
        !read_variable("SLURM_ARRAY_TASK_MIN", getenv("SLURM_ARRAY_TASK_MIN"), &first) ||
        !read_variable("SLURM_ARRAY_TASK_MAX", getenv("SLURM_ARRAY_TASK_MAX"), &last) ||
        !read_variable("SLURM_ARRAY_TASK_COUNT", getenv("SLURM_ARRAY_TASK_COUNT"), &count))
        return false;
    *shard = settled ? (struct rg_shard){id, settled} : (struct rg_shard){id - first + 1, count};
    return settled || last - first + 1 == count ||
           rg_error(
               "--shard auto: Slurm's array has gaps, so that it does not say how many shards "
               "there are; write --shard 1/4, or make a plan with `raingauge plan --shards N`");
}

static bool read_ci(struct rg_shard *shard)
{
    return read_variable("CI_NODE_INDEX", getenv("CI_NODE_INDEX"), &shard->number) &&
           read_variable("CI_NODE_TOTAL", getenv("CI_NODE_TOTAL"), &shard->count);
}

static bool read_gtest(struct rg_shard *shard)
{
    struct rg_gtest_shards shards;
    if (!rg_gtest_shards(&shards))
        return false;
    *shard = (struct rg_shard){shards.index + 1, shards.total};
    return true;
}

static bool read_auto(int settled, struct rg_shard *shard)
{
    if (getenv("SLURM_ARRAY_TASK_ID"))
        return read_slurm(settled, shard);
    if (getenv("CI_NODE_INDEX") || getenv("CI_NODE_TOTAL"))
        return read_ci(shard);
    if (getenv("GTEST_TOTAL_SHARDS") || getenv("GTEST_SHARD_INDEX"))
        return read_gtest(shard);
    return rg_error("--shard auto: neither SLURM_ARRAY_TASK_ID, CI_NODE_INDEX nor "
                    "GTEST_SHARD_INDEX is set; write --shard 1/4");
}

static bool read_pair(const char *text, struct rg_shard *shard)
{
    char end;
    return sscanf(text, "%9d/%9d%c", &shard->number, &shard->count, &end) == 2 ||
           rg_error("--shard %.40s: write it as 1/4, the first of four, or as auto", text);
}

bool rg_shard_read(const char *asked, int count, struct rg_shard *shard)
{
    if (!(strcmp(asked, "auto") ? read_pair(asked, shard) : read_auto(count, shard)))
        return false;
    if (count && shard->count != count)
        return rg_error("--shard %.40s: there are %d, and the plan is cut into %d; use as many, or "
                        "plan anew",
                        asked, shard->count, count);
    return (shard->number >= 1 && shard->number <= shard->count) ||
           rg_error("--shard %.40s: shard %d is none of 1 to %d", asked, shard->number,
                    shard->count);
}

int rg_shards_exit(const struct rg_parts *parts, const char *kind, const char *path, bool partial)
{
    if (!parts->count) {
        rg_error("%s: holds no record of a shard; name the folder of `raingauge %s --shard -o`",
                 path, kind);
        return RG_EXIT_NOTHING;
    }
    char *lacking = parts->missing ? rg_parts_lacking(parts) : NULL;
    if (!parts->missing || !lacking)
        return parts->missing ? rg_exit_of_error() : RG_EXIT_PASS;
    if (partial)
        rg_warning("%s: of %d shards are missing: %s", path, parts->count, lacking);
    else
        rg_error("%s: of %d shards are missing: %s; nothing is reported, so run these, or add "
                 "--partial",
                 path, parts->count, lacking);
    free(lacking);
    return partial ? RG_EXIT_PASS : RG_EXIT_INCONCLUSIVE;
}
