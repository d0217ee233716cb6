#include "harness/compare/bisect/bisect.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/bisect/kept.h"
#include "harness/compare/bisect/search.h"
#include "harness/compare/bisect/stamp.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"

// A bisect while it runs.
struct run {
    struct rg_bisect *bisect;
    struct rg_bisect_kept kept;
    enum rg_judgement *verdicts; // one a candidate, as the search reads them
    bool keeps;                  // verdicts can be written
};

static void keep(struct run *r)
{
    if (r->keeps && !rg_bisect_kept_write(&r->kept, r->bisect)) {
        r->keeps = false;
        rg_warning("bisect: it goes on, and would begin anew if it were interrupted");
    }
}

// Tells why the command judges nothing, where nobody has told it.
static bool stop(struct run *r, int64_t at, int status)
{
    r->bisect->end = RG_BISECT_STOPPED;
    if (status >= 0 && !rg_interrupted())
        rg_error("%s: the command ended with %d, which is no verdict (0 good, 1 bad, 3 again, 4, "
                 "77 and 125 skip); see what it printed",
                 r->bisect->candidates->names[at], status);
    return false;
}

// What a candidate is on disk once its command has ended, and the good end: each command may hold
// its candidate against that, and write there what it caches.
static void stamp(struct rg_bisect *b, int64_t at)
{
    b->judged[at].stamp = rg_candidate_stamp(b->candidates->names[at]);
    b->judged[0].stamp = rg_candidate_stamp(b->candidates->names[0]);
}

// Judges a candidate, unless that was done. False where the command can judge none.
static bool judge(struct run *r, int64_t at)
{
    struct rg_bisect *b = r->bisect;
    const char *const *names = b->candidates->names;
    if (r->verdicts[at] != RG_JUDGED_NONE)
        return true;
    const struct rg_judged judged = rg_judge(b->judging, names[at], names[0]);
    if (judged.verdict == RG_JUDGED_STOP)
        return stop(r, at, judged.status);
    b->judged[at] = judged;
    b->order[b->order_count++] = at;
    stamp(b, at);
    r->verdicts[at] = judged.verdict;
    keep(r);
    if (b->tell)
        b->tell(b, at);
    return true;
}

// --- the ends ---

// Judges an end, which is to be `wanted`. An enum rg_exit.
static int judge_end(struct run *r, int64_t at, enum rg_judgement wanted)
{
    struct rg_bisect *b = r->bisect;
    const char *word = rg_judgement_name(wanted), *name = b->candidates->names[at];
    if (!judge(r, at))
        return rg_exit_of_error();
    if (r->verdicts[at] == wanted)
        return RG_EXIT_PASS;
    b->end = wanted == RG_JUDGED_GOOD ? RG_BISECT_GOOD_END : RG_BISECT_BAD_END;
    if (r->verdicts[at] == RG_JUDGED_SKIP) {
        rg_error("--%s %s: cannot be judged, for the command ended with %d; name an end that can "
                 "be",
                 word, name, b->judged[at].status);
        return RG_EXIT_NOTHING;
    }
    rg_error("--%s %s: is %s; name an end that is %s, or a command that tells the two apart", word,
             name, rg_judgement_name(r->verdicts[at]), word);
    return RG_EXIT_FAIL;
}

// --- what lies between ---

static int halve(struct run *r)
{
    struct rg_bisect *b = r->bisect;
    for (;;) {
        const struct rg_search search = rg_search_of(r->verdicts, b->candidates->count);
        const int64_t next = rg_search_next(&search, r->verdicts);
        b->good = search.good;
        b->bad = search.bad;
        if (next < 0)
            break;
        rg_info("%lld candidate%s left, about %d more to judge", (long long)search.left,
                search.left == 1 ? "" : "s", rg_search_steps(&search));
        if (!judge(r, next))
            return rg_exit_of_error();
    }
    b->end = b->bad == b->good + 1 ? RG_BISECT_FOUND : RG_BISECT_AMONG;
    return b->end == RG_BISECT_FOUND ? RG_EXIT_PASS : RG_EXIT_INCONCLUSIVE;
}

static void take_kept(struct run *r)
{
    struct rg_bisect *b = r->bisect;
    const int64_t taken = b->fresh ? 0 : rg_bisect_kept_take(&r->kept, b);
    for (int64_t i = 0; i < b->candidates->count; i++)
        r->verdicts[i] = b->judged[i].verdict;
    if (taken)
        rg_info("goes on with %lld verdict%s of a bisect that was interrupted; --fresh takes none",
                (long long)taken, taken == 1 ? "" : "s");
    for (int64_t i = 0; b->tell && i < taken; i++)
        b->tell(b, b->order[i]);
}

// Verdicts go once it is told what they came to. Those that stay are written again, with the good
// end as the command that ended has left it.
static int end(struct run *r, int exit)
{
    struct rg_bisect *b = r->bisect;
    const bool is_told = !b->tell_end || b->tell_end(b);
    if (is_told && b->end != RG_BISECT_STOPPED)
        rg_bisect_kept_remove(&r->kept);
    else if (b->order_count) {
        stamp(b, 0);
        keep(r);
    }
    if (b->end == RG_BISECT_STOPPED && rg_interrupted()) {
        exit = RG_EXIT_SIGNALLED + rg_interrupt_signal();
        rg_info("interrupted; the same command goes on from %lld verdicts",
                (long long)b->order_count);
    } else if (!is_told && b->order_count && r->keeps) {
        rg_info("once it can be told, the same command goes on from %lld verdicts",
                (long long)b->order_count);
    }
    return is_told ? exit : rg_exit_worse(exit, RG_EXIT_HARNESS);
}

static int run(struct run *r)
{
    struct rg_bisect *b = r->bisect;
    take_kept(r);
    int exit = judge_end(r, 0, RG_JUDGED_GOOD);
    if (exit == RG_EXIT_PASS)
        exit = judge_end(r, b->candidates->count - 1, RG_JUDGED_BAD);
    if (exit == RG_EXIT_PASS)
        exit = halve(r);
    return end(r, exit);
}

int rg_bisect_run(struct rg_bisect *bisect)
{
    const size_t count = (size_t)bisect->candidates->count;
    struct run r = {.bisect = bisect, .keeps = true};
    r.verdicts = rg_alloc(count, sizeof(*r.verdicts), "bisect");
    bisect->judged = rg_alloc(count, sizeof(*bisect->judged), "bisect");
    bisect->order = rg_alloc(count, sizeof(*bisect->order), "bisect");
    bisect->bad = bisect->candidates->count - 1;
    rg_bisect_kept_find(bisect, &r.kept);
    rg_interrupt_watch();
    const bool ok = r.verdicts && bisect->judged && bisect->order;
    const int exit = ok ? run(&r) : rg_exit_of_error();
    free(r.verdicts);
    return exit;
}

void rg_bisect_free(struct rg_bisect *bisect)
{
    free(bisect->judged);
    free(bisect->order);
    bisect->judged = NULL;
    bisect->order = NULL;
}
