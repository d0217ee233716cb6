#include "harness/compare/bisect/bisect.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/bisect/search.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"

// Logs why the command's result is no verdict, unless that was logged.
static bool stop(struct rg_bisect *b, const struct rg_judged *judged)
{
    const char *const *names = b->candidates->names;
    const struct rg_search known = rg_search_of(b->verdicts, b->candidates->count);
    b->end = RG_BISECT_STOPPED;
    if (rg_interrupted())
        rg_info("interrupted; --good '%s' --bad '%s' go on from here", names[known.good],
                names[known.bad]);
    else if (judged->status >= 0)
        rg_error("%s: the command ended with %d, which is no verdict (0 good, 1 bad, 3 again, 4, "
                 "77 and 125 skip); see what it printed",
                 names[judged->at], judged->status);
    return false;
}

// Judges a candidate. False if the command can judge none.
static bool judge(struct rg_bisect *b, int64_t at)
{
    const char *const *names = b->candidates->names;
    struct rg_judged judged = rg_judge(b->judging, names[at], names[0]);
    judged.at = at;
    if (judged.verdict == RG_JUDGED_STOP)
        return stop(b, &judged);
    b->judged[b->count++] = judged;
    b->verdicts[at] = judged.verdict;
    if (b->prints)
        rg_bisect_print_verdict(b, &judged);
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
    b->end = wanted == RG_JUDGED_GOOD ? RG_BISECT_GOOD_END : RG_BISECT_BAD_END;
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
    for (;;) {
        const struct rg_search search = rg_search_of(b->verdicts, b->candidates->count);
        const int64_t next = rg_search_next(&search, b->verdicts);
        b->good = search.good;
        b->bad = search.bad;
        if (next < 0)
            break;
        rg_info("%lld candidate%s left, about %d more to judge", (long long)search.left,
                search.left == 1 ? "" : "s", rg_search_steps(&search));
        if (!judge(b, next))
            return rg_exit_of_error();
    }
    b->end = b->bad == b->good + 1 ? RG_BISECT_FOUND : RG_BISECT_AMONG;
    return b->end == RG_BISECT_FOUND ? RG_EXIT_PASS : RG_EXIT_INCONCLUSIVE;
}

int rg_bisect_run(struct rg_bisect *bisect)
{
    const size_t count = (size_t)bisect->candidates->count;
    bisect->verdicts = rg_alloc(count, sizeof(*bisect->verdicts), "bisect");
    bisect->judged = rg_alloc(count, sizeof(*bisect->judged), "bisect");
    if (!bisect->verdicts || !bisect->judged)
        return rg_exit_of_error();
    rg_interrupt_watch();
    int exit = judge_end(bisect, 0, RG_JUDGED_GOOD);
    if (exit == RG_EXIT_PASS)
        exit = judge_end(bisect, bisect->candidates->count - 1, RG_JUDGED_BAD);
    if (exit == RG_EXIT_PASS)
        exit = halve(bisect);
    return bisect->end == RG_BISECT_STOPPED && rg_interrupted()
               ? RG_EXIT_SIGNALLED + rg_interrupt_signal()
               : exit;
}

void rg_bisect_free(struct rg_bisect *bisect)
{
    free(bisect->verdicts);
    free(bisect->judged);
}
