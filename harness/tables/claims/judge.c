#include <math.h>
#include <stdio.h>
#include <string.h>

#include "harness/tables/claims/evidence.h"
#include "harness/tables/claims/margin.h"
#include "harness/tables/claims/order.h"

// The 5 % are divided between both sides.
#define ERROR_SHARE 0.025

enum { ROW_SIZE = 160, ABOUT_SIZE = 448 };

const char *rg_claim_verdict_text(enum rg_claim_verdict verdict)
{
    static const char *const texts[RG_CLAIM_VERDICTS] = {"reproduced", "not reproduced",
                                                         "undecided", "other work"};
    return texts[verdict];
}

double rg_claim_probability(const struct rg_judgement *j)
{
    return j->verdict == RG_CLAIM_NOT_REPRODUCED ? j->in_favour : j->against;
}

// --- pairs of cells ---

// P values over the parts of a claim. The whole is as sure as its least sure part; that some part
// fails is corrected for the number of parts.
struct parts {
    int count;
    double against, in_favour;
    char least_sure[ABOUT_SIZE], most_wrong[ABOUT_SIZE]; // names of these parts
};

static const struct parts no_parts = {.in_favour = 1};

static void add_probabilities(struct parts *parts, double against, double in_favour,
                              const char about[ABOUT_SIZE])
{
    if (!parts->count || against > parts->against) {
        parts->against = against;
        memcpy(parts->least_sure, about, sizeof(parts->least_sure));
    }
    if (!parts->count || in_favour < parts->in_favour) {
        parts->in_favour = in_favour;
        memcpy(parts->most_wrong, about, sizeof(parts->most_wrong));
    }
    parts->count++;
}

// The required ratio of two cells: enough to count for the claim (`holds`), and little enough to
// count against it (`fails`). They differ by the rounding of print (claims/margin.h).
struct bound {
    double holds, fails;
};

static const struct bound faster_at_all = {1, 1};

// A frame rate with at least this many digits, without an exponent.
static const char *fps_text(double fps, int digits, char text[24])
{
    if (fps < 999)
        snprintf(text, 24, "%.*g", digits, fps);
    else
        snprintf(text, 24, "%.0f", fps);
    return text;
}

// Adds the part "`faster` is at least this many times as fast as `slower`".
static void add_part(struct parts *parts, const struct rg_record *faster,
                     const struct rg_record *slower, struct bound bound)
{
    char name[2][ROW_SIZE], about[ABOUT_SIZE], fps[2][24];
    rg_record_row_name(faster, name[0], sizeof(name[0]));
    rg_record_row_name(slower, name[1], sizeof(name[1]));
    fps_text(rg_record_fps(faster), 4, fps[0]);
    fps_text(rg_record_fps(slower), 4, fps[1]);
    if (!strcmp(name[0], name[1])) // two variants of a row
        snprintf(about, sizeof(about), "%s, %s against %s: %s to %s fps", name[0], faster->variant,
                 slower->variant, fps[0], fps[1]);
    else
        snprintf(about, sizeof(about), "%s against %s: %s to %s fps", name[0], name[1], fps[0],
                 fps[1]);
    const double drift = rg_record_drift(faster, slower);
    const double against =
        rg_order_probability(faster->samples_ms, faster->sample_count, bound.holds * drift,
                             slower->samples_ms, slower->sample_count);
    const double in_favour =
        rg_order_probability(slower->samples_ms, slower->sample_count, drift / bound.fails,
                             faster->samples_ms, faster->sample_count);
    add_probabilities(parts, against, in_favour, about);
}

static struct rg_judgement judge_parts(struct evidence *e, const struct parts *parts)
{
    if (!parts->count)
        return rg_evidence_end(e, RG_CLAIM_UNDECIDED, "no two rows are there to compare");
    e->judgement.against = parts->against;
    e->judgement.in_favour = fmin(1, parts->in_favour * parts->count);
    if (e->judgement.against <= ERROR_SHARE)
        return rg_evidence_end(e, RG_CLAIM_REPRODUCED, "least sure: %s", parts->least_sure);
    if (e->judgement.in_favour <= ERROR_SHARE)
        return rg_evidence_end(e, RG_CLAIM_NOT_REPRODUCED, "%s", parts->most_wrong);
    return rg_evidence_end(e, RG_CLAIM_UNDECIDED, "the samples do not settle %s",
                           parts->least_sure);
}

// --- the tests ---

static struct rg_judgement judge_falls(struct evidence *e)
{
    struct parts parts = no_parts;
    for (int i = 0; i + 1 < e->count; i++)
        add_part(&parts, rg_evidence_row(e, e->rows[i]), rg_evidence_row(e, e->rows[i + 1]),
                 faster_at_all);
    return judge_parts(e, &parts);
}

static struct rg_judgement judge_order(struct evidence *e)
{
    struct parts parts = no_parts;
    for (int a = 0; a < e->count; a++) {
        for (int b = 0; b < e->count; b++) {
            const struct rg_record *fast = rg_evidence_row(e, e->rows[a]),
                                   *slow = rg_evidence_row(e, e->rows[b]);
            if (rg_margin_orders(rg_record_published_fps(fast), rg_record_published_fps(slow)))
                add_part(&parts, fast, slow, faster_at_all);
        }
    }
    return judge_parts(e, &parts);
}

static struct rg_judgement judge_ratio(struct evidence *e)
{
    struct parts parts = no_parts;
    const double least = e->claim->least, margin = rg_evidence_margin(e);
    add_part(&parts, rg_evidence_row(e, e->claim->first), rg_evidence_row(e, e->claim->last),
             (struct bound){least * (1 + margin), least * (1 - margin)});
    return judge_parts(e, &parts);
}

static struct rg_judgement judge_alike(struct evidence *e, double apart)
{
    struct parts parts = no_parts;
    const double margin = rg_evidence_margin(e);
    const struct bound bound = {1 / (apart * (1 - margin)), 1 / (apart * (1 + margin))};
    for (int a = 0; a < e->count; a++)
        for (int b = 0; b < e->count; b++)
            if (a != b)
                add_part(&parts, rg_evidence_row(e, e->rows[a]), rg_evidence_row(e, e->rows[b]),
                         bound);
    return judge_parts(e, &parts);
}

// The opposite of ALIKE.
static struct rg_judgement judge_apart(struct evidence *e)
{
    judge_alike(e, e->claim->least);
    struct rg_judgement *j = &e->judgement;
    const double against = j->against;
    j->against = j->in_favour;
    j->in_favour = against;
    if (j->verdict < RG_CLAIM_UNDECIDED)
        j->verdict =
            j->verdict == RG_CLAIM_REPRODUCED ? RG_CLAIM_NOT_REPRODUCED : RG_CLAIM_REPRODUCED;
    return *j;
}

static struct rg_judgement judge_faster(struct evidence *e)
{
    struct parts parts = no_parts;
    const struct bound bound = {e->claim->least, e->claim->least};
    for (int i = 0; i < e->count; i++)
        add_part(&parts, rg_evidence_row(e, e->rows[i]),
                 rg_evidence_row_of(e, e->rows[i], e->other), bound);
    return judge_parts(e, &parts);
}

// Before the crossing the second variant is faster, and from there on the first. Equal printed
// rates say neither.
static struct rg_judgement judge_crosses(struct evidence *e)
{
    struct parts parts = no_parts;
    for (int i = 0; i < e->count; i++) {
        const struct rg_record *a = rg_evidence_row(e, e->rows[i]),
                               *b = rg_evidence_row_of(e, e->rows[i], e->other);
        const bool is_crossed = e->rows[i] >= e->claim->knee;
        if (rg_record_published_fps(a) == rg_record_published_fps(b))
            continue;
        add_part(&parts, is_crossed ? a : b, is_crossed ? b : a, faster_at_all);
    }
    return judge_parts(e, &parts);
}

static struct rg_judgement judge_slowest(struct evidence *e)
{
    struct parts parts = no_parts;
    for (int i = 0; i < e->count; i++)
        if (e->rows[i] != e->claim->knee)
            add_part(&parts, rg_evidence_row(e, e->rows[i]), rg_evidence_row(e, e->claim->knee),
                     faster_at_all);
    return judge_parts(e, &parts);
}

static bool is_within(const struct rg_claim *c, int row)
{
    return row >= c->knee && row <= (c->until ? c->until : c->knee);
}

// Whether a row is faster than each row outside the range.
static struct parts beats_others(const struct evidence *e, int row)
{
    struct parts parts = no_parts;
    for (int i = 0; i < e->count; i++)
        if (!is_within(e->claim, e->rows[i]))
            add_part(&parts, rg_evidence_row(e, row), rg_evidence_row(e, e->rows[i]),
                     faster_at_all);
    return parts;
}

// Some row in the range is faster than all others; the surest is chosen, with a correction for the
// choice. The claim fails if every row in the range is beaten by a row outside it.
static struct rg_judgement judge_optimum(struct evidence *e)
{
    struct parts best = no_parts;
    struct parts beaten = {.in_favour = -1};
    int within = 0;
    for (int i = 0; i < e->count; i++) {
        if (!is_within(e->claim, e->rows[i]))
            continue;
        const struct parts one = beats_others(e, e->rows[i]);
        beaten = one.in_favour > beaten.in_favour ? one : beaten;
        best = !within++ || one.against < best.against ? one : best;
    }
    best.against = fmin(1, best.against * within);
    best.in_favour = beaten.in_favour;
    memcpy(best.most_wrong, beaten.most_wrong, sizeof(best.most_wrong));
    return judge_parts(e, &best);
}

// Counts samples on either side of the required frame rate.
static struct rg_judgement judge_rate(struct evidence *e)
{
    struct parts parts = no_parts;
    const double due_ms = 1000 / e->claim->least;
    for (int i = 0; i < e->count; i++) {
        const struct rg_record *r = rg_evidence_row(e, e->rows[i]);
        char name[ROW_SIZE], about[ABOUT_SIZE], fps[2][24];
        rg_record_row_name(r, name, sizeof(name));
        snprintf(about, sizeof(about), "%s: %s to %s fps, due are %.3g", name,
                 fps_text(1000 / r->frame_ms.high, 3, fps[0]),
                 fps_text(1000 / r->frame_ms.low, 3, fps[1]), e->claim->least);
        add_probabilities(&parts, rg_sign_probability(r->samples_ms, r->sample_count, due_ms, 1),
                          rg_sign_probability(r->samples_ms, r->sample_count, due_ms, -1), about);
    }
    return judge_parts(e, &parts);
}

static double axis_at(const struct evidence *e, int row)
{
    const struct rg_record *r = rg_evidence_row(e, row);
    for (int i = 0; i < r->row_count; i++)
        if (!*r->row[i].text)
            return r->row[i].number;
    return NAN;
}

static struct rg_judgement judge_exponent(struct evidence *e)
{
    struct rg_slope_point points[RG_RESULT_ROWS];
    for (int i = 0; i < e->count; i++) {
        const struct rg_record *r = rg_evidence_row(e, e->rows[i]);
        points[i] = (struct rg_slope_point){.x = log(axis_at(e, e->rows[i])),
                                            .samples = r->samples_ms,
                                            .count = r->sample_count,
                                            .load_ms = rg_record_load_ms(r)};
    }
    const struct rg_interval s = rg_slope_resampled(points, e->count);
    if (!isfinite(s.low))
        return rg_evidence_end(e, RG_CLAIM_UNDECIDED, "too few rows for a power");
    const double low = -s.high, high = -s.low, least = e->claim->least, most = e->claim->most;
    const enum rg_claim_verdict verdict = low >= least && high <= most ? RG_CLAIM_REPRODUCED
                                          : high < least || low > most ? RG_CLAIM_NOT_REPRODUCED
                                                                       : RG_CLAIM_UNDECIDED;
    return rg_evidence_end(e, verdict, "the power is %.2f, 95 %%: %.2f to %.2f", -s.median, low,
                           high);
}

// Errors of images are the same in every run.
static struct rg_judgement judge_flattens(struct evidence *e)
{
    const double first = rg_evidence_row(e, e->claim->first)->truth_error.flip_mask_mean;
    const double knee = rg_evidence_row(e, e->claim->knee)->truth_error.flip_mask_mean;
    const double last = rg_evidence_row(e, e->claim->last)->truth_error.flip_mask_mean;
    const bool holds = first - knee >= e->claim->least * (knee - last) && first > knee;
    return rg_evidence_end(e, holds ? RG_CLAIM_REPRODUCED : RG_CLAIM_NOT_REPRODUCED,
                           "the error falls from %.3f to %.3f, and then to %.3f", first, knee,
                           last);
}

static struct rg_judgement judge(struct evidence *e)
{
    switch (e->claim->test) {
    case RG_CLAIM_FALLS:
        return judge_falls(e);
    case RG_CLAIM_ORDER:
        return judge_order(e);
    case RG_CLAIM_RATIO:
        return judge_ratio(e);
    case RG_CLAIM_ALIKE:
        return judge_alike(e, e->claim->most);
    case RG_CLAIM_APART:
        return judge_apart(e);
    case RG_CLAIM_EXPONENT:
        return judge_exponent(e);
    case RG_CLAIM_FASTER:
        return judge_faster(e);
    case RG_CLAIM_RATE:
        return judge_rate(e);
    case RG_CLAIM_OPTIMUM:
        return judge_optimum(e);
    case RG_CLAIM_SLOWEST:
        return judge_slowest(e);
    case RG_CLAIM_CROSSES:
        return judge_crosses(e);
    case RG_CLAIM_FLATTENS:
        return judge_flattens(e);
    }
    return e->judgement;
}

// Some rows cannot confirm a claim about every row, nor that no two rows differ, because missing
// rows may refute it.
static struct rg_judgement hold_back(struct evidence *e)
{
    const enum rg_claim_test test = e->claim->test;
    const bool is_of_some =
        test == RG_CLAIM_RATIO || test == RG_CLAIM_EXPONENT || test == RG_CLAIM_FLATTENS;
    const enum rg_claim_verdict needs_all =
        test == RG_CLAIM_APART ? RG_CLAIM_NOT_REPRODUCED : RG_CLAIM_REPRODUCED;
    if (is_of_some || !e->missing || e->judgement.verdict != needs_all)
        return e->judgement;
    return rg_evidence_end(e, RG_CLAIM_UNDECIDED, "it %s in the %d of %d rows that are there",
                           test == RG_CLAIM_APART ? "does not hold" : "holds", e->count,
                           e->judgement.rows_needed);
}

struct rg_judgement rg_claim_judge(const struct rg_claim *claim, const struct rg_result *result,
                                   int device)
{
    struct evidence e = {.claim = claim, .result = result, .at = {.device = device}};
    const bool goes_on = rg_evidence_begin(&e);
    e.judgement.print_contradicts = rg_evidence_print_contradicts(&e);
    if (!goes_on)
        return e.judgement;
    judge(&e);
    return hold_back(&e);
}
