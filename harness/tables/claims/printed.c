// Tests whether a paper's own table supports its claims.
#include <math.h>
#include <string.h>

#include "harness/tables/claims/evidence.h"
#include "harness/tables/claims/margin.h"
#include "harness/tables/papers/papers.h"

// From the table, if there is one, since unmeasured rows are printed all the same.
static double printed_fps(const struct evidence *e, int row, int variant)
{
    const struct rg_table *table = rg_table_find(e->claim->table);
    const char *name = e->result->variants[variant];
    for (int v = 0; table && table->variants[v].name; v++)
        if (!strcmp(table->variants[v].name, name))
            return rg_table_published_fps(table, row - 1, v);
    return rg_result_has(e->result, row - 1)
               ? rg_record_published_fps(rg_evidence_row_of(e, row, variant))
               : NAN;
}

static bool print_falls(const struct evidence *e)
{
    bool falls = true;
    for (int i = 0; i + 1 < e->count; i++)
        falls &= printed_fps(e, e->rows[i], e->at.variant) >
                 printed_fps(e, e->rows[i + 1], e->at.variant);
    return falls;
}

static double print_apart(const struct evidence *e)
{
    double least = INFINITY, most = 0;
    for (int i = 0; i < e->count; i++) {
        least = fmin(least, printed_fps(e, e->rows[i], e->at.variant));
        most = fmax(most, printed_fps(e, e->rows[i], e->at.variant));
    }
    return most / least;
}

static bool print_is_faster(const struct evidence *e)
{
    bool faster = true;
    for (int i = 0; i < e->count; i++)
        faster &= printed_fps(e, e->rows[i], e->at.variant) >=
                  e->claim->least * printed_fps(e, e->rows[i], e->other);
    return faster;
}

static bool print_crosses(const struct evidence *e)
{
    bool crosses = true;
    for (int i = 0; i < e->count; i++) {
        const double a = printed_fps(e, e->rows[i], e->at.variant),
                     b = printed_fps(e, e->rows[i], e->other);
        crosses &= e->rows[i] < e->claim->knee ? a <= b : a >= b;
    }
    return crosses;
}

static bool print_has_slowest(const struct evidence *e)
{
    const double slowest = printed_fps(e, e->claim->knee, e->at.variant);
    bool is_slowest = true;
    for (int i = 0; i < e->count; i++)
        is_slowest &=
            e->rows[i] == e->claim->knee || slowest < printed_fps(e, e->rows[i], e->at.variant);
    return is_slowest;
}

static bool print_has_optimum(const struct evidence *e)
{
    const int until = e->claim->until ? e->claim->until : e->claim->knee;
    double within = 0, others = 0;
    for (int i = 0; i < e->count; i++) {
        const double fps = printed_fps(e, e->rows[i], e->at.variant);
        if (e->rows[i] >= e->claim->knee && e->rows[i] <= until)
            within = fmax(within, fps);
        else
            others = fmax(others, fps);
    }
    return within >= others;
}

// Takes all printed rows. False where a variant is missing, or nothing is printed.
static bool take_rows(struct evidence *e)
{
    const struct rg_claim *c = e->claim;
    const int step = rg_evidence_step(c);
    e->count = 0;
    if (e->at.variant < 0 || (c->other && e->other < 0))
        return false;
    for (int row = c->first; step > 0 ? row <= c->last : row >= c->last; row += step)
        if (isfinite(printed_fps(e, row, e->at.variant)))
            e->rows[e->count++] = row;
    return e->count > 0;
}

static bool contradicts(const struct evidence *e)
{
    const struct rg_claim *c = e->claim;
    switch (c->test) {
    case RG_CLAIM_FALLS:
        return !print_falls(e);
    case RG_CLAIM_RATIO:
        return printed_fps(e, c->first, e->at.variant) <
               c->least * printed_fps(e, c->last, e->at.variant);
    case RG_CLAIM_ALIKE:
        return print_apart(e) > c->most;
    case RG_CLAIM_APART:
        return print_apart(e) < c->least;
    case RG_CLAIM_FASTER:
        return !print_is_faster(e);
    case RG_CLAIM_CROSSES:
        return !print_crosses(e);
    case RG_CLAIM_SLOWEST:
        return !print_has_slowest(e);
    case RG_CLAIM_OPTIMUM:
        return !print_has_optimum(e);
    default:
        return false;
    }
}

bool rg_evidence_print_contradicts(const struct evidence *e)
{
    struct evidence printed = *e;
    if (printed.at.work < 0)
        printed.at.work = 0; // all works have the same printed numbers
    return take_rows(&printed) && contradicts(&printed);
}

// The largest rounding error, where a claim is about all its rows.
static double most_rounding(const struct evidence *e)
{
    double most = 0;
    for (int i = 0; i < e->count; i++)
        most = fmax(most, rg_margin_rounding(printed_fps(e, e->rows[i], e->at.variant)));
    return most;
}

double rg_evidence_margin(const struct evidence *e)
{
    const struct rg_claim *c = e->claim;
    if (c->test != RG_CLAIM_RATIO)
        return 2 * most_rounding(e);
    return c->least == 1 ? 0
                         : rg_margin_rounding(printed_fps(e, c->first, e->at.variant)) +
                               rg_margin_rounding(printed_fps(e, c->last, e->at.variant));
}
