// Tests whether a paper's own table supports its claims.
#include <math.h>
#include <string.h>

#include "harness/tables/claims/hearing.h"
#include "harness/tables/claims/margin.h"
#include "harness/tables/papers/papers.h"

// From the table, if there is one, since unmeasured rows are printed all the same.
static double printed_fps(const struct hearing *h, int row, int variant)
{
    const struct rg_table *table = rg_table_find(h->claim->table);
    const char *name = h->result->variants[variant];
    for (int v = 0; table && table->variants[v].name; v++)
        if (!strcmp(table->variants[v].name, name))
            return rg_table_published_fps(table, row - 1, v);
    return rg_result_has(h->result, row - 1)
               ? rg_record_published_fps(rg_hearing_row_of(h, row, variant))
               : NAN;
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
        crosses &= h->rows[i] < h->claim->knee ? a <= b : a >= b;
    }
    return crosses;
}

static bool print_has_slowest(const struct hearing *h)
{
    const double slowest = printed_fps(h, h->claim->knee, h->at.variant);
    bool is_slowest = true;
    for (int i = 0; i < h->count; i++)
        is_slowest &=
            h->rows[i] == h->claim->knee || slowest < printed_fps(h, h->rows[i], h->at.variant);
    return is_slowest;
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

// Takes all printed rows. False where a variant is missing, or nothing is printed.
static bool take_rows(struct hearing *h)
{
    const struct rg_claim *c = h->claim;
    const int step = rg_hearing_step(c);
    h->count = 0;
    if (h->at.variant < 0 || (c->other && h->other < 0))
        return false;
    for (int row = c->first; step > 0 ? row <= c->last : row >= c->last; row += step)
        if (isfinite(printed_fps(h, row, h->at.variant)))
            h->rows[h->count++] = row;
    return h->count > 0;
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
    case RG_CLAIM_SLOWEST:
        return !print_has_slowest(h);
    case RG_CLAIM_OPTIMUM:
        return !print_has_optimum(h);
    default:
        return false;
    }
}

bool rg_hearing_print_contradicts(const struct hearing *h)
{
    struct hearing printed = *h;
    if (printed.at.work < 0)
        printed.at.work = 0; // all works have the same printed numbers
    return take_rows(&printed) && contradicts(&printed);
}

// The largest rounding error, where a claim is about all its rows.
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
