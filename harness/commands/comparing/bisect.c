// raingauge bisect: finds the first bad one in an ordered list of candidates, as judged by a
// command; or gives the command's verdict to git.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/compare/bisect/bisect.h"
#include "harness/console/duration.h"
#include "harness/console/interrupt.h"

struct bisect_options {
    char *good, *bad; // candidates; NULL: git has its own
    char *line;       // a shell command
    char *list;       // a file
    char *budget;     // "2m"
    int tries, crash;
    bool json;
};

#define AT(field) offsetof(struct bisect_options, field)

enum { CRASH_SKIP, CRASH_BAD };
static const char *const crashes[] = {"skip", "bad", NULL};

static const struct rg_option options[] = {
    RG_GROUP("What to search"),
    {RG_OPTION_OPERAND, .argument = "CANDIDATE",
     .about =
         "what to try, in order: devices with their variables, folders of builds, or any words",
     .names = RG_NAMES_FILE, .first = 1},
    {RG_OPTION_TEXT, "list", .argument = "FILE",
     .about =
         "a file with one candidate a line; empty lines and lines that begin with # are ignored",
     .offset = AT(list), .names = RG_NAMES_FILE},
    {RG_OPTION_TEXT, "good", .argument = "A",
     .about = "the candidate known to be good; if neither A nor B is among the candidates, the "
              "candidates lie between A and B",
     .offset = AT(good), .names = RG_NAMES_FILE},
    {RG_OPTION_TEXT, "bad", .argument = "B", .about = "the candidate known to be bad",
     .offset = AT(bad), .names = RG_NAMES_FILE},
    RG_GROUP("How to judge a candidate"),
    {RG_OPTION_TEXT, "run", .argument = "COMMAND",
     .about = "a shell command that judges one candidate: \"$RG_CANDIDATE\" is the candidate, "
              "\"$RG_GOOD\" the good end, \"$RG_BUDGET\" a time. The command's exit status is the "
              "verdict: 0 good; 1 bad; 3 try again; 4, 77 and 125 skip; any other status stops the "
              "search (docs/ci.md)",
     .offset = AT(line)},
    {RG_OPTION_INT, "tries", .argument = "N",
     .about = "the number of tries of a candidate whose status is 3, before it is skipped",
     .offset = AT(tries), .initial = "3", .least = 1, .most = 16},
    {RG_OPTION_TEXT, "budget", .argument = "TIME",
     .about = "the time of the first try, in RG_BUDGET; each further try gets twice the time of "
              "the last",
     .offset = AT(budget), .initial = "2m"},
    {RG_OPTION_CHOICE, "crash",
     .about = "the verdict on a candidate whose command ends by a signal", .offset = AT(crash),
     .initial = "skip", .choices = crashes},
    RG_GROUP("Output"),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

// --- inside `git bisect run` ---

static int judge_for_git(const struct rg_judging *judging)
{
    rg_interrupt_watch();
    const struct rg_judged judged = rg_judge(judging, NULL, NULL);
    rg_info("%s (exit status %d, %d %s)", rg_judgement_name(judged.verdict), judged.status,
            judged.tries, judged.tries == 1 ? "try" : "tries");
    return rg_judgement_git(judged.verdict);
}

// --- a list ---

static int search(const struct bisect_options *o, const struct rg_candidates *candidates,
                  const struct rg_judging *judging)
{
    struct rg_bisect bisect = {.candidates = candidates, .judging = judging, .prints = !o->json};
    int exit = rg_bisect_run(&bisect);
    if (o->json && !rg_bisect_print_json(&bisect, stdout))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    rg_bisect_free(&bisect);
    return exit;
}

static int bisect_list(const struct bisect_options *o, const struct rg_words *arguments,
                       const struct rg_judging *judging)
{
    struct rg_candidates candidates = {.count = 0};
    bool ok = rg_candidates_add(o->good, &candidates) &&
              (!o->list || rg_candidates_read(o->list, &candidates));
    for (int i = 0; ok && i < arguments->count; i++)
        ok = rg_candidates_add(arguments->items[i], &candidates);
    ok = ok && rg_candidates_add(o->bad, &candidates) && rg_candidates_between(&candidates);
    const int exit = ok ? search(o, &candidates, judging) : rg_bisect_status_of_error();
    rg_candidates_free(&candidates);
    return exit;
}

// --- the command ---

static bool check(const struct bisect_options *o, const struct rg_words *arguments, bool *is_git)
{
    const bool has_list = o->list || arguments->count;
    *is_git = !o->good && !o->bad && !has_list;
    if (!o->line)
        return rg_error(
            "bisect: --run names the command that judges, as in `raingauge bisect "
            "--good A --bad B --run 'raingauge gate \"$RG_GOOD\" \"$RG_CANDIDATE\"' X Y`");
    if (o->list && arguments->count)
        return rg_error("--list %s and '%s': name candidates in one of the two", o->list,
                        arguments->items[0]);
    if (*is_git)
        return !o->json || rg_error("bisect: inside `git bisect run` there are no candidates; "
                                    "leave out --json");
    return (o->good && o->bad) ||
           rg_error("bisect: --good and --bad name the two ends; --%s is missing",
                    o->good ? "bad" : "good");
}

// Refuses {budget}, {} and {good}, which stand for nothing: a shell would read a name put in their
// place as code.
static bool has_no_blank(const char *line, bool is_git)
{
    static const char *const blanks[][2] = {{"{budget}", RG_VARIABLE_BUDGET},
                                            {"{}", RG_VARIABLE_CANDIDATE},
                                            {"{good}", RG_VARIABLE_GOOD}};
    for (int i = 0; i < (is_git ? 1 : 3); i++)
        if (strstr(line, blanks[i][0]))
            return rg_error("--run '%.200s': %s stands for nothing; write \"$%s\", or put the line "
                            "into a script",
                            line, blanks[i][0], blanks[i][1]);
    return true;
}

static int bisect(const void *values, const struct rg_words *arguments)
{
    const struct bisect_options *o = values;
    struct rg_judging judging = {
        .line = o->line, .tries = o->tries, .crash_is_bad = o->crash == CRASH_BAD};
    if (!check(o, arguments, &judging.prints_here) ||
        !rg_duration_read(o->budget, "--budget", &judging.budget_s) ||
        !has_no_blank(o->line, judging.prints_here))
        return rg_bisect_status_of_error();
    return judging.prints_here ? judge_for_git(&judging) : bisect_list(o, arguments, &judging);
}

const struct rg_command rg_command_bisect = {
    .name = "bisect",
    .reader = RG_FOR_DRIVERS,
    .usage = "[--good A --bad B] --run COMMAND [--list FILE | CANDIDATE...] [--json]",
    .about = "finds the first bad one of several drivers or builds, or judges a commit for `git "
             "bisect run`",
    .options = options,
    .options_size = sizeof(struct bisect_options),
    .run = bisect,
    .refused = rg_bisect_status_of_error,
};
