#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "harness/console/duration.h"
#include "harness/tables/claims/evidence.h"

const char *rg_claim_verdict_text(enum rg_claim_verdict verdict)
{
    static const char *const texts[RG_CLAIM_VERDICTS] = {
        "reproduced", "not reproduced", "at the bound", "undecided",
        "other work", "not seen",       "one launch"};
    return texts[verdict];
}

const char *rg_judgement_text(const struct rg_judgement *j)
{
    static const char *const figures[RG_FIGURES_COUNT] = {"one launch: fits", "one launch: misses",
                                                          "one launch: near the bound", "not seen"};
    return j->verdict == RG_CLAIM_ONE_LAUNCH ? figures[j->figures]
                                             : rg_claim_verdict_text(j->verdict);
}

bool rg_claim_is_decided(enum rg_claim_verdict verdict)
{
    return verdict <= RG_CLAIM_AT_BOUND;
}

static enum rg_claim_figures figures_of(enum rg_settled settled)
{
    static const enum rg_claim_figures of[] = {[RG_SETTLED_HOLDS] = RG_FIGURES_FIT,
                                               [RG_SETTLED_FAILS] = RG_FIGURES_MISS,
                                               [RG_SETTLED_AT_BOUND] = RG_FIGURES_NEAR,
                                               [RG_SETTLED_OPEN] = RG_FIGURES_NONE};
    return of[settled];
}

static enum rg_claim_verdict verdict_of(enum rg_settled settled)
{
    static const enum rg_claim_verdict of[] = {[RG_SETTLED_HOLDS] = RG_CLAIM_REPRODUCED,
                                               [RG_SETTLED_FAILS] = RG_CLAIM_NOT_REPRODUCED,
                                               [RG_SETTLED_AT_BOUND] = RG_CLAIM_AT_BOUND,
                                               [RG_SETTLED_OPEN] = RG_CLAIM_UNDECIDED};
    return of[settled];
}

// --- errors of images ---

// Errors of images are the same in every launch, so one launch decides.
static struct rg_judgement judge_errors(struct evidence *e)
{
    const double first = rg_evidence_row(e, e->claim->first)->truth_error.flip_mask_mean;
    const double knee = rg_evidence_row(e, e->claim->knee)->truth_error.flip_mask_mean;
    const double last = rg_evidence_row(e, e->claim->last)->truth_error.flip_mask_mean;
    const double times = (first - knee) / (knee - last);
    const bool is_flat = knee <= last; // it does not fall any more
    const double off = is_flat ? INFINITY : log(times / e->claim->least);
    const enum rg_settled settled = first <= knee                      ? RG_SETTLED_FAILS
                                    : fabs(off) <= rg_settle_rule.near ? RG_SETTLED_AT_BOUND
                                    : off > 0                          ? RG_SETTLED_HOLDS
                                                                       : RG_SETTLED_FAILS;
    e->judgement.figures = figures_of(settled);
    rg_evidence_end(e, verdict_of(settled), "the error falls from %.3f to %.3f, and then to %.3f",
                    first, knee, last);
    const size_t used = strlen(e->judgement.why);
    if (!is_flat && first > knee)
        snprintf(e->judgement.why + used, sizeof(e->judgement.why) - used,
                 ": %.3g times as far, needed: %.3g", times, e->claim->least);
    return e->judgement;
}

// --- launches ---

static void say(struct evidence *e, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void say(struct evidence *e, const char *format, ...)
{
    const size_t used = strlen(e->judgement.why);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(e->judgement.why + used, sizeof(e->judgement.why) - used, format, arguments);
    va_end(arguments);
}

// Bounds of our own are given with the bound up to which the verdict stays the same.
static void say_turn(struct evidence *e, const struct rg_claim_parts *parts,
                     const struct rg_settling *s)
{
    const struct rg_settle_part *part = &parts->parts[s->part];
    const double turn = fabs(s->of.median - part->least) < fabs(s->of.median - part->most)
                            ? fmin(s->of.high, fmax(s->of.low, part->least))
                            : fmax(s->of.low, fmin(s->of.high, part->most));
    if (e->claim->is_ours && isfinite(turn))
        say(e, "; the bound is ours, and the verdict turns at %.3g",
            e->claim->test == RG_CLAIM_EXPONENT ? turn / parts->scale : exp(turn));
}

static void say_launches(struct evidence *e, const struct rg_settling *s)
{
    struct rg_judgement *j = &e->judgement;
    say(e, "; %d launches", j->launches);
    if (j->disturbed)
        say(e, ", and %d that others disturbed", j->disturbed);
    if (s->settled != RG_SETTLED_OPEN)
        return;
    if (s->is_unconfirmed)
        say(e, ", whose second half does not confirm the first");
    char took[RG_DURATION_TEXT];
    const int left = s->needed - s->launches;
    if (left > 0)
        say(e, "; some %d more would probably decide", left);
    if (left > 0 && j->launch_s > 0)
        say(e, ", in %s", rg_duration_text(left * j->launch_s, took));
}

static struct rg_judgement judge_launches(struct evidence *e, struct rg_claim_parts *parts)
{
    struct rg_judgement *j = &e->judgement;
    const int launches = e->launches < RG_SETTLE_LAUNCHES ? e->launches : RG_SETTLE_LAUNCHES;
    const struct rg_settling s =
        rg_settle(&rg_settle_rule, parts->join, parts->parts, parts->count, launches);
    j->launches = launches ? s.launches : 0;
    j->more = s.more;
    j->needed = s.settled == RG_SETTLED_OPEN ? s.needed : 0;
    rg_evidence_end(e, verdict_of(s.settled), "%s", "");
    if (launches)
        rg_claim_part_tell(e, parts, s.part, &s.of, j->why, sizeof(j->why));
    else
        say(e, "all launches were disturbed");
    if (s.settled == RG_SETTLED_HOLDS || s.settled == RG_SETTLED_FAILS)
        say_turn(e, parts, &s);
    say_launches(e, &s);
    return *j;
}

// --- one launch ---

static enum rg_settled look_once(const struct evidence *e, struct rg_claim_parts *parts,
                                 const struct rg_settle_rule *rule, int *part)
{
    if (!rg_claim_parts_make(e, parts))
        return RG_SETTLED_OPEN;
    return rg_settle_once(rule, parts->join, parts->parts, parts->count, part);
}

static void take_figures(struct evidence *e, struct rg_claim_parts *parts)
{
    int part = 0;
    rg_evidence_take_medians(e);
    e->judgement.figures = figures_of(look_once(e, parts, &rg_settle_rule, &part));
    if (e->judgement.figures == RG_FIGURES_NONE) {
        rg_evidence_end(e, RG_CLAIM_NOT_SEEN, "no two rows are there to compare");
        return;
    }
    const struct rg_interval of = {parts->values[part][0], NAN, NAN};
    rg_evidence_end(e, RG_CLAIM_ONE_LAUNCH, "%s", "");
    rg_claim_part_tell(e, parts, part, &of, e->judgement.why, sizeof(e->judgement.why));
    say(e, "; one launch, which decides nothing");
}

static bool print_contradicts(const struct evidence *e, struct rg_claim_parts *parts)
{
    const struct rg_settle_rule exact = {.near = 0};
    struct evidence print;
    int part;
    memcpy(&print, e, offsetof(struct evidence, logs));
    return rg_evidence_take_print(&print) &&
           look_once(&print, parts, &exact, &part) == RG_SETTLED_FAILS;
}

struct rg_judgement rg_claim_judge(const struct rg_claim *claim, const struct rg_result *result,
                                   int device)
{
    struct rg_claim_parts parts;
    struct evidence e;
    memset(&e, 0, offsetof(struct evidence, logs));
    memset(&e.judgement, 0, sizeof(e.judgement));
    e.claim = claim;
    e.result = result;
    e.at.device = device;
    const bool goes_on = rg_evidence_begin(&e);
    e.judgement.print_contradicts = print_contradicts(&e, &parts);
    if (!goes_on)
        return e.judgement;
    if (claim->test == RG_CLAIM_FLATTENS)
        return judge_errors(&e);
    take_figures(&e, &parts);
    e.launches = 0;
    if (e.judgement.verdict == RG_CLAIM_NOT_SEEN || !rg_evidence_take_launches(&e))
        return e.judgement;
    rg_claim_parts_make(&e, &parts);
    return judge_launches(&e, &parts);
}
