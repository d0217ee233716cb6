#include "harness/compare/bisect/bisect.h"

#include <jansson.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/record/named.h"

static const char stopped[] = "stopped"; // the command judged nothing, or was interrupted

// Logs why the command's result is no verdict, unless that was logged.
static void tell_stop(const struct rg_bisect *b, int64_t at, const struct rg_judged *judged)
{
    const char *const *names = b->candidates->names;
    if (rg_interrupted())
        rg_info("interrupted; --good '%s' --bad '%s' go on from here", names[b->found.good],
                names[b->found.bad]);
    else if (judged->status >= 0)
        rg_error("%s: the command ended with %d, which is no verdict (0 good, 1 bad, 3 again, 4, "
                 "77 and 125 skip); see what it printed",
                 names[at], judged->status);
}

// Judges a candidate. False if the command can judge none.
static bool judge(struct rg_bisect *b, int64_t at)
{
    const char *const *names = b->candidates->names;
    struct rg_judged judged = rg_judge(b->judging, names[at], names[0]);
    char time[RG_DURATION_TEXT];
    if (judged.verdict == RG_JUDGED_STOP) {
        tell_stop(b, at, &judged);
        return false;
    }
    judged.at = at;
    b->judged[b->count++] = judged;
    b->verdicts[at] = judged.verdict;
    b->found = rg_search_of(b->verdicts, b->candidates->count);
    if (!b->prints)
        return true;
    printf("%-4s  %s  (exit status %d, %s", rg_judgement_name(judged.verdict), names[at],
           judged.status, rg_duration_text(judged.seconds, time));
    printf(judged.tries > 1 ? ", %d tries)\n" : ")\n", judged.tries);
    fflush(stdout);
    return true;
}

// Judges an end of the list, which has to be `wanted`. Returns an enum rg_exit.
static int judge_end(struct rg_bisect *b, int64_t at, enum rg_judgement wanted)
{
    const char *word = rg_judgement_name(wanted), *name = b->candidates->names[at];
    if (!judge(b, at))
        return rg_exit_of_error();
    if (b->verdicts[at] == wanted)
        return RG_EXIT_PASS;
    b->end = wanted == RG_JUDGED_GOOD ? "good is not good" : "bad is not bad";
    if (b->verdicts[at] == RG_JUDGED_SKIP) {
        rg_error("--%s %s: cannot be judged, for the command ended with %d; name an end that can "
                 "be",
                 word, name, b->judged[b->count - 1].status);
        return RG_EXIT_NOTHING;
    }
    rg_error("--%s %s: is %s; name an end that is %s, or a command that tells the two apart", word,
             name, rg_judgement_name(b->verdicts[at]), word);
    return RG_EXIT_FAIL;
}

static int halve(struct rg_bisect *b)
{
    const struct rg_search *found = &b->found;
    const char *const *names = b->candidates->names;
    while (found->next >= 0) {
        rg_info("%lld candidate%s left, about %d more to judge", (long long)found->left,
                found->left == 1 ? "" : "s", found->steps);
        if (!judge(b, found->next))
            return rg_exit_of_error();
    }
    const bool is_one = found->bad == found->good + 1;
    b->end = is_one ? "found" : "one of several";
    if (b->prints && is_one)
        printf("the first bad one is %s; %s before it is good\n", names[found->bad],
               names[found->good]);
    else if (b->prints)
        printf("%s is good; the first bad one is one of these, of which the last alone was "
               "judged:\n",
               names[found->good]);
    for (int64_t i = found->good + 1; b->prints && !is_one && i <= found->bad; i++)
        printf("  %s\n", names[i]);
    return is_one ? RG_EXIT_PASS : RG_EXIT_INCONCLUSIVE;
}

int rg_bisect_run(struct rg_bisect *bisect)
{
    const int64_t count = bisect->candidates->count;
    bisect->end = stopped;
    bisect->verdicts = rg_alloc((size_t)count, sizeof(*bisect->verdicts), "bisect");
    bisect->judged = rg_alloc((size_t)count, sizeof(*bisect->judged), "bisect");
    if (!bisect->verdicts || !bisect->judged)
        return rg_exit_of_error();
    bisect->found = rg_search_of(bisect->verdicts, count);
    rg_interrupt_watch();
    int exit = judge_end(bisect, 0, RG_JUDGED_GOOD);
    if (exit == RG_EXIT_PASS)
        exit = judge_end(bisect, count - 1, RG_JUDGED_BAD);
    if (exit == RG_EXIT_PASS)
        exit = halve(bisect);
    return bisect->end == stopped && rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal()
                                                      : exit;
}

void rg_bisect_free(struct rg_bisect *bisect)
{
    free(bisect->verdicts);
    free(bisect->judged);
}

bool rg_bisect_print_json(const struct rg_bisect *b, FILE *out)
{
    const char *const *names = b->candidates->names;
    const int64_t last = b->candidates->count - 1;
    const bool is_known = b->verdicts && b->verdicts[last] == RG_JUDGED_BAD && b->found.next < 0;
    json_t *judged = json_array(), *suspects = json_array();
    for (int64_t i = 0; i < b->count; i++) {
        const struct rg_judged *j = &b->judged[i];
        json_array_append_new(
            judged, json_pack("{so ss si si so}", "candidate", rg_json_text(names[j->at]),
                              "verdict", rg_judgement_name(j->verdict), "status", j->status,
                              "tries", j->tries, "seconds", rg_number_json(j->seconds)));
    }
    for (int64_t i = b->found.good + 1; is_known && i <= b->found.bad; i++)
        json_array_append_new(suspects, rg_json_text(names[i]));
    json_t *json = json_pack("{si so so so si ss so so}", "format", 1, "command",
                             rg_json_text(b->judging->line), "good", rg_json_text(names[0]), "bad",
                             rg_json_text(names[last]), "candidates", (int)last + 1, "end", b->end,
                             "first_bad", suspects, "judged", judged);
    const bool is_made =
        json && !json_dumpf(json, out, JSON_INDENT(1) | JSON_REAL_PRECISION(RG_NUMBER_DIGITS));
    json_decref(json);
    fputc('\n', out);
    return is_made ||
           rg_harness_error("JSON: cannot be written; see that there is memory and disk");
}
