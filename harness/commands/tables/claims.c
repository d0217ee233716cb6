// raingauge claims: decides by launches whether papers' claims about their tables hold.
#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/tables/chosen.h"
#include "harness/commands/tables/inputs.h"
#include "harness/commands/tables/verdicts.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/console/started.h"
#include "harness/record/output.h"
#include "harness/tables/launching/launches.h"
#include "harness/tables/papers/papers.h"
#include "harness/tables/print.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/runs/regenerate.h"

struct claims_options {
    struct rg_length length;
    struct rg_devices_asked devices;
    char *output, *from; // NULL: none
    char *budget;        // "8h"; NULL: none
    int format;          // index into rg_result_formats
    bool fresh, wide, json;
    int64_t memory_bytes;
    struct rg_claim_outcomes *outcomes;
};

#define AT(field) offsetof(struct claims_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to measure"),
    {RG_OPTION_OPERAND, .argument = "ID",
     .about = "a table whose claims to decide, or a file with a table of your own. With --budget, "
              "--quick or --full, no name means all tables that have claims",
     .names = RG_NAMES_TABLE, .first = 1},
    RG_INCLUDE(rg_length_options, AT(length), NULL),
    {RG_OPTION_TEXT, "budget", .argument = "TIME",
     .about = "starts no launch later than this time after the command's start, such as 30m or 8h; "
              "open claims then say how many more launches they need",
     .offset = AT(budget)},
    {RG_OPTION_FLAG, "fresh", .about = "ignores the measurements that an interrupted run stored",
     .offset = AT(fresh)},
    {RG_OPTION_TEXT, "from", .argument = "FILE|DIR",
     .about = "judges stored launches, instead of measuring: those that -o or an interrupted run "
              "left in FILE or DIR",
     .offset = AT(from), .names = RG_NAMES_FILE,
     .excludes = "device quick full fresh budget output"},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_CHOICE, "format", .about = "the format of the output", .offset = AT(format),
     .choices = rg_result_formats, .initial = "md"},
    {RG_OPTION_FLAG, "wide", .about = "prints each claim's section and the reason for its verdict",
     .offset = AT(wide), .excludes = "format json"},
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "writes the tables with their launches into this folder, in every format",
     .offset = AT(output), .letter = 'o', .names = RG_NAMES_FOLDER},
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static const struct rg_claims_shown all = {.first_row = 0};

// Judges a measured table, and writes it once no launch is due; until then its journal has it.
static int add(const struct rg_result *result, const void *user)
{
    const struct claims_options *o = user;
    const struct rg_launches_wanted wanted = {.claims = rg_claims};
    const bool is_whole = rg_result_first_missing(result) > result->last_row;
    int exit = rg_claims_add(o->outcomes, result, NULL, &all) ? rg_result_exit(result)
                                                              : rg_exit_of_error();
    if (is_whole && o->output && !rg_launches_are_due(result, &wanted) &&
        !rg_result_write(result, o->output))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    return exit;
}

static int print(const void *user)
{
    const struct claims_options *o = user;
    return rg_verdicts_print(o->outcomes, o->json   ? RG_RESULT_JSON
                                          : o->wide ? RG_RESULT_WIDE
                                                    : o->format);
}

// The named tables, or all that have claims. False, and one logged line, if one is unknown or has
// none.
static bool choose(const struct rg_words *ids, const struct rg_table *chosen[], int *count)
{
    *count = 0;
    for (int i = 0; i < ids->count; i++) {
        chosen[*count] = rg_table_find(ids->items[i]);
        if (!chosen[*count] || !rg_has_claims(chosen[*count]))
            return rg_error("claims '%s': %s; `raingauge table --claims --from results/tables` "
                            "names the tables that have claims",
                            ids->items[i],
                            chosen[*count] ? "the paper claims nothing of this table"
                                           : "no such table");
        ++*count;
    }
    for (int i = 0; rg_tables[i] && !ids->count; i++)
        if (rg_has_claims(rg_tables[i]))
            chosen[(*count)++] = rg_tables[i];
    return true;
}

static int measure(const struct claims_options *o, const struct rg_words *arguments)
{
    const struct rg_table *chosen[RG_MAX_WORDS];
    struct rg_devices devices;
    double budget_s = 0;
    int count;
    if ((o->budget && !rg_duration_read(o->budget, "--budget", &budget_s)) ||
        !choose(arguments, chosen, &count) ||
        !rg_length_is_asked("claims", arguments, &o->length, o->budget) ||
        !rg_inputs_are_spared(chosen, count, NULL, o->output) ||
        (o->output && !rg_results_can_be_written(chosen, count, o->output)))
        return rg_exit_of_error();
    const struct rg_regenerate_options wanted = {.full = o->length.full,
                                                 .fresh = o->fresh,
                                                 .decides = true,
                                                 .budget_s = budget_s,
                                                 .begin_ms = rg_started_ms(),
                                                 .folder = o->output,
                                                 .print = add,
                                                 .print_end = print,
                                                 .user = o};
    int exit = rg_devices_open_asked(&o->devices, &devices);
    if (exit != RG_EXIT_PASS)
        return exit;
    exit = rg_exit_worse(rg_tables_regenerate(chosen, count, &devices, &wanted),
                         rg_devices_exit(&devices));
    return rg_devices_end(&devices, exit);
}

static int judge(const struct claims_options *o, const struct rg_words *arguments)
{
    struct rg_stored stored = {0};
    bool ok = rg_stored_read(&stored, o->from) &&
              rg_verdicts_can_be_of(o->outcomes, &stored, arguments, o->from);
    for (int i = 0; ok && i < stored.count; i++)
        if (rg_words_name(arguments, stored.results[i].table))
            ok = rg_claims_add(o->outcomes, &stored.results[i], NULL, &all);
    rg_stored_free(&stored);
    if (ok && !o->outcomes->count)
        ok = rg_error("%s: holds no table of these about which a paper claims something; name "
                      "another folder",
                      o->from);
    return ok ? print(o) : rg_exit_of_error();
}

static int claims(const void *values, const struct rg_words *arguments)
{
    struct claims_options o = *(const struct claims_options *)values;
    struct rg_claim_outcomes outcomes = {0};
    o.outcomes = &outcomes;
    rg_memory_allow(o.memory_bytes);
    struct rg_words ids;
    const int exit = !rg_tables_read(arguments, &ids) ? rg_exit_of_error()
                     : o.from                         ? judge(&o, &ids)
                                                      : measure(&o, &ids);
    rg_claims_free(&outcomes);
    return exit;
}

const struct rg_command rg_command_claims = {
    .name = "claims",
    .reader = RG_FOR_PAPERS,
    .usage = "[ID...] [--device D,...|all] [--quick|--full] [--budget TIME] [--fresh] "
             "[--from FILE|DIR] [--wide] [--format F|--json] [-o DIR]",
    .about = "decides by many launches whether the papers' claims about their tables hold",
    .options = options,
    .options_size = sizeof(struct claims_options),
    .run = claims,
};
