// raingauge table: regenerates the papers' tables, or prints stored results.
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/text/words.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/commands/tables/chosen.h"
#include "harness/commands/tables/inputs.h"
#include "harness/commands/tables/plan_shard.h"
#include "harness/commands/tables/sets.h"
#include "harness/commands/tables/verdicts.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/console/started.h"
#include "harness/record/disk/stored.h"
#include "harness/record/output.h"
#include "harness/tables/claims/outcomes.h"
#include "harness/tables/papers/papers.h"
#include "harness/tables/print.h"
#include "harness/tables/runs/compile.h"
#include "harness/tables/runs/regenerate.h"

struct table_options {
    struct rg_range rows; // 0: not given
    struct rg_length length;
    struct rg_devices_asked devices;
    char *output;         // a folder
    char *from;           // a file or folder; NULL: the tables are measured
    int format;           // index into rg_result_formats
    int work;             // index into `works`
    int launches;         // of each cell; 1: none
    char *variant;        // NULL: all
    struct rg_words sets; // of --set
    char *set;            // the same joined; NULL: none
    char *budget;         // "4m"; NULL: none
    bool fresh, claims, wide, json, compile;
    int64_t memory_bytes;
    char *plan, *shard;                 // NULL: none
    char *kept;                         // a folder of launches; NULL: none
    struct rg_stored *kept_results;     // what it holds
    struct rg_claim_outcomes *outcomes; // collected for --claims
    int *printed;                       // number of tables so far; an empty line separates them
};

#define AT(field) offsetof(struct table_options, field)

static const char *const works[] = {"paper", "reading", "ours", "queries", NULL};

static const struct rg_option options[] = {
    RG_GROUP("What to measure"),
    {RG_OPTION_OPERAND, .argument = "ID",
     .about =
         "tables to measure; `raingauge list tables` prints the names. A name that has a slash or "
         "ends in .table is a file with a table of your own (docs/tables.md). With --budget, "
         "--quick, --full, --from or --compile, no name means all tables of the papers",
     .names = RG_NAMES_TABLE, .first = 1},
    {RG_OPTION_RANGE, "rows", .argument = "A-B", .about = "selects only these rows, counted from 1",
     .offset = AT(rows), .least = 1, .most = INT_MAX},
    {RG_OPTION_CHOICE, "work",
     .about = "measures only this kind of work: paper, as the paper describes it; reading, as the "
              "paper can also be read; ours, with everything that saves work; queries, with the "
              "API's occlusion queries",
     .offset = AT(work), .choices = works},
    {RG_OPTION_TEXT, "variant", .argument = "NAME",
     .about = "selects only this variant of each row: full, no_geometry", .offset = AT(variant)},
    {RG_OPTION_TEXTS, "set", .argument = "KEY=VALUE",
     .about = "sets a parameter in all cells and overrides their rows; the result is then not "
              "compared with the published numbers",
     .offset = AT(sets)},
    RG_INCLUDE(rg_length_options, AT(length), NULL),
    {RG_OPTION_INT, "launches", .argument = "N",
     .about = "also times each cell in this many launches, each of which is a new process; rates "
              "and intervals then come from the launches",
     .offset = AT(launches), .least = 2, .most = 24, .excludes = "budget from"},
    {RG_OPTION_TEXT, "budget", .argument = "TIME",
     .about = "measures as much as fits into this time from the command's start, such as 90s or "
              "4m: first the rows that curves and claims need, in small pictures, then more. The "
              "end of the output says what is missing",
     .offset = AT(budget), .excludes = "full rows work variant set from fresh"},
    {RG_OPTION_FLAG, "fresh", .about = "ignores the measurements that an interrupted run stored",
     .offset = AT(fresh)},
    {RG_OPTION_TEXT, "from", .argument = "FILE|DIR",
     .about = "prints stored results, instead of measuring: those that -o, --json or an "
              "interrupted run left in FILE or DIR",
     .offset = AT(from), .names = RG_NAMES_FILE, .excludes = "device quick full fresh set"},
    {RG_OPTION_FLAG, "compile",
     .about = "lets all drivers compile and cache the tables' shaders side by side, instead of "
              "measuring",
     .offset = AT(compile),
     .excludes = "full quick launches rows work variant set from fresh budget claims kept "
                 "format wide output json"},
    RG_GROUP("A plan of several machines (docs/farm.md)"),
    {RG_OPTION_TEXT, "plan", .argument = "FILE",
     .about = "measures the cells of a plan that `raingauge plan -o` wrote, on the plan's devices. "
              "-o names the folder for the records, one for each group of cells; groups with a "
              "record there are skipped",
     .offset = AT(plan), .names = RG_NAMES_FILE,
     .excludes = "rows work variant set quick full launches budget fresh from compile device "
                 "require claims kept format wide json"},
    RG_INCLUDE(rg_shard_option, AT(shard), NULL),
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_devices_option, AT(devices.names), "all"),
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_FLAG, "claims",
     .about = "prints the papers' claims about the tables, and whether each claim holds, instead "
              "of the tables",
     .offset = AT(claims)},
    {RG_OPTION_TEXT, "kept", .argument = "DIR",
     .about = "with --claims: takes verdicts from launches that `raingauge claims -o` wrote into "
              "this folder, and says where today's figures differ",
     .offset = AT(kept), .names = RG_NAMES_FOLDER},
    {RG_OPTION_CHOICE, "format", .about = "the format of the output", .offset = AT(format),
     .choices = rg_result_formats, .initial = "md"},
    {RG_OPTION_FLAG, "wide",
     .about = "prints all columns and notes, one line a cell; with --claims, the reason for every "
              "verdict",
     .offset = AT(wide), .excludes = "format json"},
    {RG_OPTION_TEXT, "output", .argument = "DIR",
     .about = "writes each table into this folder too, in every format", .offset = AT(output),
     .letter = 'o', .names = RG_NAMES_FOLDER},
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

static const char *chosen_work(const struct table_options *o)
{
    return o->work < 0 ? NULL : works[o->work];
}

// --- output ---

static int form_of(const struct table_options *o)
{
    return o->json ? RG_RESULT_JSON : o->wide ? RG_RESULT_WIDE : o->format;
}

// The folder for a machine's tables: that of -o, or one in it if there are several machines. False,
// and one logged line, if its name is too long.
static bool folder_of(const struct table_options *o, const struct rg_result *result,
                      char folder[PATH_MAX])
{
    const struct rg_origins *origins = &o->outcomes->origins;
    const int origin = origins->count > 1 ? rg_origins_known(origins, result->passport) : -1;
    return snprintf(folder, PATH_MAX, "%s%s%s", o->output, origin < 0 ? "" : "/",
                    origin < 0 ? "" : origins->all[origin].key) < PATH_MAX ||
           rg_error("-o %.80s...: is too long a path; choose a shorter one", o->output);
}

// Prints a table, and writes it when it is complete; with --claims only judges it.
static int print(const struct rg_result *result, const void *user)
{
    const struct table_options *o = user;
    char folder[PATH_MAX];
    struct rg_place first = rg_result_start(result);
    if (o->output && !folder_of(o, result, folder))
        return rg_exit_of_error();
    if (!o->claims && rg_result_next(result, &first) && (*o->printed)++)
        printf("\n");
    if (!o->claims)
        return rg_result_finish(result, form_of(o), o->output ? folder : NULL);
    const bool is_whole = rg_result_first_missing(result) > result->last_row;
    const struct rg_claims_shown shown = {o->variant, o->rows.first, o->rows.last};
    int exit = rg_claims_add(o->outcomes, result, o->kept_results, &shown) ? rg_result_exit(result)
                                                                           : rg_exit_of_error();
    if (is_whole && o->output && !rg_result_write(result, folder))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    return exit;
}

static int print_claims(const void *user)
{
    const struct table_options *o = user;
    return rg_verdicts_print(o->outcomes, form_of(o));
}

// --- tables that are measured ---

static bool has_variant(const struct rg_table *table, const char *wanted)
{
    bool has = !wanted;
    for (const struct rg_table_variant *v = table->variants; v->name; v++)
        has = has || !strcmp(v->name, wanted);
    return has;
}

static bool has_work(const struct rg_table *table, const char *wanted)
{
    bool has = !wanted || !table->works[0].name;
    for (const struct rg_table_work *work = table->works; work->name; work++)
        has = has || !strcmp(work->name, wanted);
    return has;
}

// Whether each table's technique accepts the assignments. False, and one logged line, if one does
// not.
static bool take_sets(const struct rg_words *sets, const struct rg_table *const chosen[], int count)
{
    bool ok = true;
    for (int i = 0; ok && sets->count && i < count; i++) {
        void *settings = rg_subject_settings(rg_technique_find(chosen[i]->technique), sets);
        ok = settings != NULL;
        free(settings);
    }
    return ok;
}

// The named tables, or all that have the work and the variant. False, and one logged line, if one
// is unknown or lacks them.
static bool choose(const struct rg_words *ids, const struct table_options *o,
                   const struct rg_table *chosen[], int *count)
{
    const char *work = chosen_work(o);
    *count = 0;
    for (int i = 0; i < ids->count; i++) {
        chosen[(*count)++] = rg_table_find(ids->items[i]);
        if (!chosen[i])
            return rg_table_refuse(ids->items[i]);
        if (!has_work(chosen[i], work))
            return rg_error("--work %s: table '%s' has no such work; choose paper or ours", work,
                            ids->items[i]);
        if (!has_variant(chosen[i], o->variant))
            return rg_error("--variant %s: table '%s' times no such thing; its first is %s",
                            o->variant, ids->items[i], chosen[i]->variants[0].name);
    }
    for (int i = 0; rg_tables[i] && !ids->count && i < RG_MAX_WORDS; i++)
        if (has_work(rg_tables[i], work) && has_variant(rg_tables[i], o->variant))
            chosen[(*count)++] = rg_tables[i];
    return *count || rg_error("--variant %s: no table times such a thing", o->variant);
}

// Whether some table has all requested rows; the others then give the rows that they have.
static bool have_rows(struct rg_range rows, const struct rg_table *const chosen[], int count)
{
    const struct rg_table *longest = chosen[0];
    for (int i = 1; i < count; i++)
        longest = chosen[i]->row_count > longest->row_count ? chosen[i] : longest;
    if (rows.last <= longest->row_count)
        return true;
    return rg_error("--rows %d-%d: %s has rows 1-%d", rows.first, rows.last, longest->id,
                    longest->row_count);
}

static bool refuse_claims(const char *table)
{
    return rg_error("--claims: the paper claims nothing of table '%s'; leave it out, or name "
                    "another table",
                    table);
}

// With --claims, only tables with claims are measured.
static bool have_claims(const struct table_options *o, const struct rg_table *const chosen[],
                        int count)
{
    bool any = !o->claims;
    for (const struct rg_claim *claim = rg_claims; !any && claim->table; claim++)
        for (int i = 0; !any && i < count; i++)
            any = !strcmp(claim->table, chosen[i]->id);
    return any || refuse_claims(chosen[0]->id);
}

static int compile(const struct table_options *o, const struct rg_table *const chosen[], int count)
{
    struct rg_devices devices;
    const int exit = rg_devices_open_asked(&o->devices, &devices);
    if (exit != RG_EXIT_PASS)
        return exit;
    return rg_devices_end(&devices, rg_exit_worse(rg_tables_compile(chosen, count, &devices),
                                                  rg_devices_exit(&devices)));
}

static int measure(const struct table_options *o, const struct rg_words *arguments)
{
    const struct rg_table *chosen[RG_MAX_WORDS];
    int count;
    double budget_s = 0;
    if ((o->budget && !rg_duration_read(o->budget, "--budget", &budget_s)) ||
        !choose(arguments, o, chosen, &count) || !have_rows(o->rows, chosen, count) ||
        !take_sets(&o->sets, chosen, count))
        return rg_exit_of_error();
    if (o->compile)
        return compile(o, chosen, count);
    if (!rg_length_is_asked("table", arguments, &o->length, o->budget))
        return rg_exit_of_error();
    const struct rg_regenerate_options wanted = {.first_row = o->rows.first,
                                                 .last_row = o->rows.last,
                                                 .full = o->length.full,
                                                 .launches = o->launches > 1 ? o->launches : 0,
                                                 .fresh = o->fresh,
                                                 .work = chosen_work(o),
                                                 .variant = o->variant,
                                                 .set = o->set,
                                                 .budget_s = budget_s,
                                                 .begin_ms = rg_started_ms(),
                                                 .folder = o->output,
                                                 .print = print,
                                                 .print_end = print_claims,
                                                 .user = o};
    struct rg_devices devices;
    if (!have_claims(o, chosen, count) || !rg_inputs_are_spared(chosen, count, o->set, o->output) ||
        (o->output && !rg_results_can_be_written(chosen, count, o->output)))
        return rg_exit_of_error();
    int exit = rg_devices_open_asked(&o->devices, &devices);
    if (exit != RG_EXIT_PASS)
        return exit;
    exit = rg_exit_worse(rg_tables_regenerate(chosen, count, &devices, &wanted),
                         rg_devices_exit(&devices));
    return rg_devices_end(&devices, exit);
}

// --- results that lie on disk ---

// Whether -o names no folder that --from reads, or that is a machine's in one, since only a part of
// its results would be left. False, and one logged line, if it does.
static bool spares_stored(const struct table_options *o, const char *folder)
{
    char found[PATH_MAX], *slash = realpath(folder, found) ? strrchr(found, '/') : NULL;
    const bool is_machine = slash && rg_key_is(slash + 1);
    if (is_machine)
        *slash = 0;
    return (!rg_file_is_in(o->from, folder) && !(is_machine && rg_file_is_same(o->from, found))) ||
           rg_error("%s: holds what --from reads, which would be replaced; name another folder "
                    "with -o, or leave it out",
                    folder);
}

// Finds the machines of the results that are asked for, and makes the folder of their folders.
static bool find_machines(const struct rg_stored *stored, const struct table_options *o,
                          const struct rg_words *ids)
{
    char folder[PATH_MAX];
    bool ok = true;
    for (int i = 0; ok && i < stored->count; i++)
        ok = !rg_words_name(ids, stored->results[i].table) ||
             rg_origins_find(&o->outcomes->origins, stored->results[i].passport) >= 0;
    for (int i = 0; ok && o->output && i < stored->count; i++)
        ok = folder_of(o, &stored->results[i], folder) && spares_stored(o, folder);
    return ok && (!o->output || o->outcomes->origins.count < 2 || rg_output_folder(o->output));
}

// Drops the parts of a result that were not requested. False if nothing is left. Claims are judged
// by all that is stored and only then shown in part, so that no filter changes a verdict.
static bool keep(struct rg_result *result, const struct table_options *o)
{
    result->is_part = o->rows.first || chosen_work(o) || o->variant;
    if (o->claims && !o->output)
        return true;
    return (!o->rows.first || rg_result_keep_rows(result, o->rows.first - 1, o->rows.last - 1)) &&
           (!chosen_work(o) || rg_result_keep_work(result, chosen_work(o))) &&
           (!o->variant || rg_result_keep_variant(result, o->variant));
}

// Names the machine of the tables that follow, in the forms that have room for it.
static void print_machine(const struct table_options *o, int origin)
{
    const struct rg_origin *of = &o->outcomes->origins.all[origin];
    const int form = form_of(o);
    char name[RG_ORIGIN_NAME];
    if (o->claims || form == RG_RESULT_CSV || form == RG_RESULT_JSON)
        return;
    rg_origin_name(origin, name);
    printf("%s%s %s: %s, key %s\n\n", *o->printed ? "\n" : "", form == RG_RESULT_TEX ? "%" : "#",
           name, of->text, of->key);
    *o->printed = 0;
}

// Prints the results of a machine that are asked for; returns their number.
static int print_origin(struct rg_stored *stored, const struct table_options *o,
                        const struct rg_words *ids, int origin, int *exit)
{
    const struct rg_origins *origins = &o->outcomes->origins;
    int printed = 0;
    for (int i = 0; i < stored->count; i++) {
        struct rg_result *result = &stored->results[i];
        if (!rg_words_name(ids, result->table) ||
            rg_origins_known(origins, result->passport) != origin || !keep(result, o))
            continue;
        if (!printed++ && origins->count > 1)
            print_machine(o, origin);
        *exit = rg_exit_worse(*exit, print(result, o));
    }
    return printed;
}

static int print_stored(struct rg_stored *stored, const struct table_options *o,
                        const struct rg_words *ids)
{
    int exit = RG_EXIT_PASS, printed = 0;
    if (!find_machines(stored, o, ids) ||
        (o->claims && !rg_verdicts_can_be_of(o->outcomes, stored, ids, o->from)))
        return rg_exit_of_error();
    for (int i = 0; i < o->outcomes->origins.count; i++)
        printed += print_origin(stored, o, ids, i, &exit);
    if (printed && exit == RG_EXIT_NOTHING)
        rg_error("%s: of some of its cells, or all, nothing was measured; measure the table anew",
                 o->from);
    if (printed && (!o->claims || o->outcomes->count || exit != RG_EXIT_PASS))
        return exit;
    if (printed) {
        refuse_claims(ids->count ? ids->items[0] : stored->results[0].table);
        return rg_exit_of_error();
    }
    rg_error("%s: holds nothing of the tables, rows and works that are asked for; without them "
             "`raingauge table --from` prints what it holds",
             o->from);
    return rg_exit_of_error();
}

static int print_tables(const struct table_options *o, const struct rg_words *arguments)
{
    struct rg_stored stored = {0};
    if (!o->from)
        return measure(o, arguments);
    if (o->output && !spares_stored(o, o->output))
        return rg_exit_of_error();
    const int exit =
        rg_stored_read(&stored, o->from) ? print_stored(&stored, o, arguments) : rg_exit_of_error();
    rg_stored_free(&stored);
    return rg_exit_worse(exit, print_claims(o));
}

static bool needs_claims(const struct table_options *o)
{
    return o->claims || rg_error("--kept: is about claims; add --claims, or leave it out");
}

static int measure_shard(const struct table_options *o, const struct rg_words *arguments)
{
    const struct rg_shard_asked asked = {o->plan, o->shard, o->output, o->devices.timeout_s};
    if (o->plan && !arguments->count)
        return rg_shard_run(&asked);
    if (o->plan)
        rg_error("--plan: the plan names the tables; leave out '%s'", arguments->items[0]);
    else
        rg_error("--shard: is of a plan; name it, as --plan plan.json");
    return rg_exit_of_error();
}

static int table(const void *values, const struct rg_words *arguments)
{
    struct table_options o = *(const struct table_options *)values;
    struct rg_claim_outcomes outcomes = {0};
    int printed = 0;
    o.outcomes = &outcomes;
    o.printed = &printed;
    rg_memory_allow(o.memory_bytes);
    if (o.plan || o.shard)
        return measure_shard(&o, arguments);
    struct rg_stored kept = {0};
    o.kept_results = &kept;
    if (!rg_sets_join(&o.sets, &o.set))
        return rg_exit_of_error();
    struct rg_words ids;
    const bool is_read = rg_tables_read(arguments, &ids) &&
                         (!o.kept || (needs_claims(&o) && rg_stored_read(&kept, o.kept)));
    const int exit = is_read ? print_tables(&o, &ids) : rg_exit_of_error();
    rg_stored_free(&kept);
    free(o.set);
    rg_claims_free(&outcomes);
    return exit;
}

const struct rg_command rg_command_table = {
    .name = "table",
    .reader = RG_FOR_PAPERS,
    .usage = "[ID...] [--device D,...|all] [--quick|--full] [--launches N] [--rows A-B] [--work "
             "paper|reading|ours|queries] "
             "[--variant NAME] [--set KEY=VALUE]... [--claims] [--kept DIR] [--wide] [--format "
             "F|--json] [-o DIR] "
             "[--budget TIME] [--fresh] [--from FILE|DIR] [--compile] [--plan FILE [--shard "
             "I/N|auto]]",
    .about =
        "measures the papers' tables on every device, and prints them beside the published numbers",
    .options = options,
    .options_size = sizeof(struct table_options),
    .run = table,
};
