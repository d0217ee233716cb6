// raingauge plan: names the cells that several machines measure together, or what is left of them.
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/tables/chosen.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/devices/measure/calibration.h"
#include "harness/record/passport/build_info.h"
#include "harness/tables/farm/cut.h"
#include "harness/tables/farm/found.h"
#include "harness/tables/farm/make.h"

enum { MOST_SHARDS = 100000 };

struct plan_options {
    struct rg_length length;
    char *devices;
    char *from;   // NULL: no records
    char *output; // NULL: not given
    int shards;   // 0: not given
    bool missing;
};

#define AT(field) offsetof(struct plan_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to plan"),
    {RG_OPTION_OPERAND, .argument = "ID|PLAN DIR",
     .about = "tables to plan; `raingauge list tables` prints the names, and no name means all "
              "tables. With --missing: a plan, and the folders of its records",
     .names = RG_NAMES_TABLE, .first = 1},
    RG_INCLUDE(rg_length_options, AT(length), NULL),
    RG_INCLUDE(rg_devices_option, AT(devices), "cpu"),
    {RG_OPTION_TEXT, "from", .argument = "FILE|DIR",
     .about = "earlier results, from which the plan estimates how long each cell takes",
     .offset = AT(from), .names = RG_NAMES_FILE},
    {RG_OPTION_INT, "shards", .argument = "N",
     .about = "the number of shards; the plan can then be divided only into this number",
     .offset = AT(shards), .least = 1, .most = MOST_SHARDS},
    {RG_OPTION_TEXT, "output", .argument = "FILE", .about = "the file that the plan is written to",
     .offset = AT(output), .letter = 'o', .names = RG_NAMES_FILE},
    RG_GROUP("What is missing"),
    {RG_OPTION_FLAG, "missing",
     .about = "prints the shards that lack records, in the form that `sbatch --array` takes; "
              "prints nothing if no shard lacks one",
     .offset = AT(missing), .excludes = "quick full device from output"},
    {RG_OPTION_END},
};

// --- a plan ---

static double load_ms(void)
{
    struct rg_calibration calibration = {.load = rg_calibration_load};
    double begin_ms, end_ms;
    rg_calibration_take(&calibration);
    rg_calibration_tell(&calibration, &begin_ms, &end_ms);
    return begin_ms;
}

static int64_t largest(const struct rg_farm_plan *plan)
{
    int64_t found = 0;
    for (int64_t g = 1; g < plan->group_count; g++)
        found = plan->groups[g].seconds > plan->groups[found].seconds ? g : found;
    return found;
}

// False, with one logged line, when memory runs out.
static bool tell_shards(const struct rg_farm_plan *plan, double all_s)
{
    char longest[RG_DURATION_TEXT], mean[RG_DURATION_TEXT];
    double longest_s;
    int *shard_of = rg_alloc((size_t)plan->group_count, sizeof(*shard_of), "shards");
    const bool ok = shard_of && rg_farm_cut(plan, plan->shards, shard_of, &longest_s);
    if (ok)
        printf("%d shards: the longest %s, the mean %s\n", plan->shards,
               rg_duration_text(longest_s, longest), rg_duration_text(all_s / plan->shards, mean));
    free(shard_of);
    return ok;
}

static bool tell(struct rg_farm_plan *plan, const char *path, int64_t known)
{
    const double all_s = rg_farm_sum(plan);
    const struct rg_farm_group *most = &plan->groups[largest(plan)];
    char all[RG_DURATION_TEXT], one[RG_DURATION_TEXT];
    printf("%s: %lld cell%s in %lld group%s, expected %s; the largest is %s, %s\n", path,
           (long long)plan->cell_count, plan->cell_count == 1 ? "" : "s",
           (long long)plan->group_count, plan->group_count == 1 ? "" : "s",
           rg_duration_text(all_s, all), most->id, rg_duration_text(most->seconds, one));
    if (known < plan->cell_count)
        rg_warning("%lld of %lld cells are in no record, so that their times are guessed %s",
                   (long long)(plan->cell_count - known), (long long)plan->cell_count,
                   known ? "by those of other cells; --from names records"
                         : "by how fast this machine is; --from names records");
    return !plan->shards || tell_shards(plan, all_s);
}

static bool fill(struct rg_farm_plan *plan, const struct plan_options *o,
                 const struct rg_table *const chosen[], int count, int64_t *known)
{
    struct rg_stored stored = {0};
    bool ok = (!o->from || rg_stored_read(&stored, o->from)) &&
              rg_farm_name_devices(plan, o->devices) && rg_farm_make(plan, chosen, count);
    *known = ok ? rg_farm_expect(plan, chosen, count, &stored, load_ms()) : -1;
    rg_stored_free(&stored);
    return *known >= 0;
}

static int make(const struct plan_options *o, const struct rg_words *ids)
{
    const struct rg_table *chosen[RG_MAX_WORDS];
    struct rg_farm_plan plan = {.full = o->length.full, .shards = o->shards};
    int count;
    int64_t known;
    rg_text_copy(plan.commit, sizeof(plan.commit), rg_build_commit);
    const bool ok =
        (o->output || rg_error("plan: name the file to write it to, as -o plan.json")) &&
        rg_tables_choose(ids, chosen, &count) && fill(&plan, o, chosen, count, &known) &&
        rg_farm_plan_write(&plan, o->output) && tell(&plan, o->output, known);
    rg_farm_plan_free(&plan);
    return ok ? RG_EXIT_PASS : rg_exit_of_error();
}

// --- what is left ---

// Prints the shards with a group that has no record. False, with one logged line, without memory.
static bool print_missing(const struct rg_farm_plan *plan, const struct rg_farm_records *found,
                          int shards)
{
    int *shard_of = rg_alloc((size_t)plan->group_count, sizeof(*shard_of), "shards");
    bool *lacks = rg_alloc((size_t)shards, sizeof(*lacks), "shards");
    char *text = rg_alloc((size_t)shards, RG_SHARD_NUMBER, "shards");
    const bool ok = shard_of && lacks && text && rg_farm_cut(plan, shards, shard_of, NULL);
    for (int64_t g = 0; ok && g < plan->group_count; g++)
        if (found->first_of[g] < 0)
            lacks[shard_of[g] - 1] = true;
    if (ok)
        rg_shard_array(lacks, shards, text, (size_t)shards * RG_SHARD_NUMBER);
    if (ok && *text)
        printf("%s\n", text);
    free(shard_of);
    free(lacks);
    free(text);
    return ok;
}

static int print_left(const struct plan_options *o, const struct rg_words *words)
{
    struct rg_farm_plan plan = {0};
    struct rg_farm_records found = {0};
    bool ok = words->count > 1 || rg_error("plan --missing: name a plan and folders of records");
    ok = ok && rg_farm_plan_read(&plan, words->items[0]);
    const int shards = plan.shards ? plan.shards : o->shards;
    if (ok && plan.shards && o->shards && plan.shards != o->shards)
        ok = rg_error("--shards %d: the plan is cut into %d; leave it out", o->shards, plan.shards);
    ok = ok && (shards || rg_error("plan --missing: the plan does not say how many shards there "
                                   "are; add --shards N"));
    ok = ok && rg_farm_records_find(&found, &plan, words->items + 1, words->count - 1) &&
         print_missing(&plan, &found, shards);
    rg_farm_found_free(&found);
    rg_farm_plan_free(&plan);
    return ok ? RG_EXIT_PASS : rg_exit_of_error();
}

static int run(const void *values, const struct rg_words *arguments)
{
    const struct plan_options *o = values;
    const int exit = o->missing ? print_left(o, arguments) : make(o, arguments);
    if (!fflush(stdout) && !ferror(stdout))
        return exit;
    rg_stdout_error();
    return rg_exit_worse(exit, rg_exit_of_error());
}

const struct rg_command rg_command_plan = {
    .name = "plan",
    .reader = RG_FOR_PAPERS,
    .usage = "[ID...] [--device D,...] [--quick|--full] [--from FILE|DIR] [--shards N] -o FILE  |  "
             "--missing PLAN DIR... [--shards N]",
    .about = "divides cells among several machines, by how long each cell is expected to take",
    .options = options,
    .options_size = sizeof(struct plan_options),
    .run = run,
};
