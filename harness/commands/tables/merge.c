// raingauge merge: one run from the records of a plan's shards.
#include "core/base/files/file.h"
#include "core/base/log.h"
#include "harness/commands/cli/command.h"
#include "harness/console/exit.h"
#include "harness/record/output.h"
#include "harness/tables/farm/merge.h"

struct merge_options {
    char *output; // NULL: not given
    bool partial;
};

#define AT(field) offsetof(struct merge_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to merge"),
    {RG_OPTION_OPERAND, .argument = "PLAN DIR...",
     .about = "a plan, and the folders with the records of its shards", .names = RG_NAMES_FILE,
     .first = 1},
    {RG_OPTION_FLAG, "partial",
     .about = "merges the records that are there, even if cells are missing",
     .offset = AT(partial)},
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "writes the tables into this folder, in every format; if machines differ, each "
              "comparison key has its own folder in DIR",
     .offset = AT(output), .letter = 'o', .names = RG_NAMES_FOLDER},
    {RG_OPTION_END},
};

static bool refuse_folder(const char *folder)
{
    return rg_error("-o %s: holds the records that are merged; name another folder", folder);
}

static bool is_asked_well(const struct merge_options *o, const struct rg_words *words)
{
    bool ok = words->count > 1 || rg_error("merge: name a plan and folders of records");
    ok = ok && (o->output || rg_error("merge: name the folder of the tables, as -o tables"));
    for (int i = 1; ok && i < words->count; i++)
        ok = !rg_file_is_same(o->output, words->items[i]) || refuse_folder(o->output);
    return ok && rg_output_can_be_written(o->output, RG_OUTPUT_TABLE_BYTES);
}

// The status where cells are missing; RG_EXIT_PASS where that is allowed, or none is.
static int missing(const struct merge_options *o, const struct rg_farm_plan *plan,
                   const struct rg_farm_records *found, const char *path)
{
    const int64_t cells = rg_farm_missing(found, plan);
    if (!found->count) {
        rg_error("%s: no folder has a record of it; name those that `raingauge table --plan` wrote "
                 "to",
                 path);
        return RG_EXIT_NOTHING;
    }
    if (!cells || o->partial)
        return RG_EXIT_PASS;
    rg_error(
        "%s: %lld of %lld cells are missing, and nothing is merged; `raingauge plan --missing` "
        "names their shards, and --partial merges the others",
        path, (long long)cells, (long long)plan->cell_count);
    return RG_EXIT_INCONCLUSIVE;
}

static int merge(const void *values, const struct rg_words *words)
{
    const struct merge_options *o = values;
    struct rg_farm_plan plan = {0};
    struct rg_farm_records found = {0};
    const bool ok = is_asked_well(o, words) && rg_farm_plan_read(&plan, words->items[0]) &&
                    rg_farm_records_find(&found, &plan, words->items + 1, words->count - 1);
    int exit = ok ? missing(o, &plan, &found, words->items[0]) : rg_exit_of_error();
    if (exit == RG_EXIT_PASS)
        exit = rg_farm_merge(&plan, &found, o->output);
    rg_farm_found_free(&found);
    rg_farm_plan_free(&plan);
    return exit;
}

const struct rg_command rg_command_merge = {
    .name = "merge",
    .reader = RG_FOR_PAPERS,
    .usage = "PLAN DIR... [--partial] -o DIR",
    .about = "merges the records of a plan's shards into one run",
    .options = options,
    .options_size = sizeof(struct merge_options),
    .run = merge,
};
