// Whether a paper's own table bears out what it claims.
#include <math.h>

#include "harness/tables/claims/hearing.h"
#include "harness/tables/claims/margin.h"

static double printed_fps(const struct hearing *h, int row, int variant)
{
    return rg_record_published_fps(rg_hearing_row_of(h, row, variant));
}

static bool print_falls(const struct hearing *h)
{
    bool falls = true;
    for (int i = 0; i + 1 < h->count; i++)
        falls &= printed_fps(h, h->rows[i], h->at.variant) >
                 printed_fps(h, h->rows[i + 1], h->at.variant);
    return falls;
}

static double print_apart(const struct hearing *h)
{
    double least = INFINITY, most = 0;
    for (int i = 0; i < h->count; i++) {
        least = fmin(least, printed_fps(h, h->rows[i], h->at.variant));
        most = fmax(most, printed_fps(h, h->rows[i], h->at.variant));
    }
    return most / least;
}

static bool print_is_faster(const struct hearing *h)
{
    bool faster = true;
    for (int i = 0; i < h->count; i++)
        faster &= printed_fps(h, h->rows[i], h->at.variant) >=
                  h->claim->least * printed_fps(h, h->rows[i], h->other);
    return faster;
}

static bool print_crosses(const struct hearing *h)
{
    bool crosses = true;
    for (int i = 0; i < h->count; i++) {
        const double a = printed_fps(h, h->rows[i], h->at.variant),
                     b = printed_fps(h, h->rows[i], h->other);
        crosses &= h->rows[i] < h->claim->knee ? !rg_margin_orders(a, b) : !rg_margin_orders(b, a);
    }
    return crosses;
}

static bool print_has_optimum(const struct hearing *h)
{
    const int until = h->claim->until ? h->claim->until : h->claim->knee;
    double within = 0, others = 0;
    for (int i = 0; i < h->count; i++) {
        const double fps = printed_fps(h, h->rows[i], h->at.variant);
        if (h->rows[i] >= h->claim->knee && h->rows[i] <= until)
            within = fmax(within, fps);
        else
            others = fmax(others, fps);
    }
    return within >= others;
}

// Takes all rows that are there, since what is printed of them does not depend on how they were
// measured. False where an end or a variant is missing.
static bool take_rows(struct hearing *h)
{
    const struct rg_claim *c = h->claim;
    const int step = rg_hearing_step(c);
    if (h->at.variant < 0 || (c->other && h->other < 0) || !rg_hearing_has_row(h, c->first) ||
        !rg_hearing_has_row(h, c->last))
        return false;
    h->at.work = h->at.work < 0 ? 0 : h->at.work;
    h->count = 0;
    for (int row = c->first; step > 0 ? row <= c->last : row >= c->last; row += step)
        if (rg_hearing_has_row(h, row))
            h->rows[h->count++] = row;
    return isfinite(printed_fps(h, c->first, h->at.variant));
}

static bool contradicts(const struct hearing *h)
{
    const struct rg_claim *c = h->claim;
    switch (c->test) {
    case RG_CLAIM_FALLS:
        return !print_falls(h);
    case RG_CLAIM_RATIO:
        return printed_fps(h, c->first, h->at.variant) <
               c->least * printed_fps(h, c->last, h->at.variant);
    case RG_CLAIM_ALIKE:
        return print_apart(h) > c->most;
    case RG_CLAIM_APART:
        return print_apart(h) < c->least;
    case RG_CLAIM_FASTER:
        return !print_is_faster(h);
    case RG_CLAIM_CROSSES:
        return !print_crosses(h);
    case RG_CLAIM_OPTIMUM:
        return !print_has_optimum(h);
    default:
        return false;
    }
}

bool rg_hearing_print_contradicts(const struct hearing *h)
{
    struct hearing printed = *h;
    return take_rows(&printed) && contradicts(&printed);
}

// Of what differs most in print, where a claim is about all its rows.
static double most_rounding(const struct hearing *h)
{
    double most = 0;
    for (int i = 0; i < h->count; i++)
        most = fmax(most, rg_margin_rounding(printed_fps(h, h->rows[i], h->at.variant)));
    return most;
}

double rg_hearing_margin(const struct hearing *h)
{
    const struct rg_claim *c = h->claim;
    if (c->test != RG_CLAIM_RATIO)
        return 2 * most_rounding(h);
    return c->least == 1 ? 0
                         : rg_margin_rounding(printed_fps(h, c->first, h->at.variant)) +
                               rg_margin_rounding(printed_fps(h, c->last, h->at.variant));
}
