// A claim as parts: quantities of a launch, with the claim's bounds.
#include <math.h>
#include <stdio.h>

#include "harness/tables/claims/evidence.h"
#include "harness/tables/claims/margin.h"

static bool add(struct rg_claim_parts *p, struct rg_claim_part of, double least, double most)
{
    if (p->count == RG_CLAIM_PARTS)
        return false;
    p->of[p->count] = of;
    p->parts[p->count] =
        (struct rg_settle_part){.values = p->values[p->count], .least = least, .most = most};
    p->count++;
    return true;
}

static void fill_ratio(const struct evidence *e, const struct rg_claim_part *of, double *values)
{
    for (int l = 0; l < e->launches; l++)
        values[l] = e->logs[l][of->slow][of->slow_variant] - e->logs[l][of->fast][of->fast_variant];
}

// Adds "row `fast` is from `least` to `most` times as fast as row `slow`", both by their index.
static void add_rows(const struct evidence *e, struct rg_claim_parts *p, int fast, int slow,
                     double least, double most)
{
    const struct rg_claim_part of = {.slow = slow, .fast = fast};
    if (add(p, of, least > 0 ? log(least) : -INFINITY, log(most)))
        fill_ratio(e, &of, p->values[p->count - 1]);
}

// Adds "one of a row's variants is at least this many times as fast as the other".
static void add_variants(const struct evidence *e, struct rg_claim_parts *p, int row, int fast,
                         double least)
{
    const struct rg_claim_part of = {row, row, !fast, fast, RG_PART_ROWS};
    if (add(p, of, log(least), INFINITY))
        fill_ratio(e, &of, p->values[p->count - 1]);
}

// The slope of the logarithm of the time on the row's place, over all places.
static void add_trend(const struct evidence *e, struct rg_claim_parts *p)
{
    const double middle = (e->count - 1) / 2.0;
    double squares = 0;
    if (!add(p, (struct rg_claim_part){.slow = e->count - 1, .about = RG_PART_TREND}, 0, INFINITY))
        return;
    for (int i = 0; i < e->count; i++)
        squares += (i - middle) * (i - middle);
    for (int l = 0; l < e->launches; l++) {
        double sum = 0;
        for (int i = 0; i < e->count; i++)
            sum += (i - middle) * e->logs[l][i][0];
        p->values[p->count - 1][l] = sum / squares * (e->count - 1);
    }
}

static void make_falls(const struct evidence *e, struct rg_claim_parts *p)
{
    add_trend(e, p);
    add_rows(e, p, 0, e->count - 1, RG_CLAIM_FALL, INFINITY);
    p->of[p->count - 1].about = RG_PART_WHOLE_FALL;
    for (int i = 0; i + 1 < e->count; i++)
        add_rows(e, p, i, i + 1, 1 / RG_CLAIM_REVERSAL, INFINITY);
}

static void make_order(const struct evidence *e, struct rg_claim_parts *p)
{
    for (int a = 0; a < e->count; a++)
        for (int b = 0; b < e->count; b++)
            if (rg_margin_orders(rg_evidence_printed(e, e->rows[a], 0),
                                 rg_evidence_printed(e, e->rows[b], 0)))
                add_rows(e, p, a, b, 1, INFINITY);
}

static void make_alike(const struct evidence *e, struct rg_claim_parts *p, double apart)
{
    for (int a = 0; a < e->count; a++)
        for (int b = a + 1; b < e->count; b++)
            add_rows(e, p, a, b, 1 / apart, apart);
}

// Before the crossing the second variant is faster, and from there on the first. Equal printed
// rates say neither.
static void make_crosses(const struct evidence *e, struct rg_claim_parts *p)
{
    for (int i = 0; i < e->count; i++) {
        const bool is_crossed = e->rows[i] >= e->claim->knee;
        if (rg_evidence_printed(e, e->rows[i], 0) != rg_evidence_printed(e, e->rows[i], 1))
            add_variants(e, p, i, !is_crossed, 1);
    }
}

static void make_slowest(const struct evidence *e, struct rg_claim_parts *p)
{
    int knee = 0;
    while (knee < e->count && e->rows[knee] != e->claim->knee)
        knee++;
    for (int i = 0; i < e->count; i++)
        if (i != knee)
            add_rows(e, p, i, knee, 1, INFINITY);
}

static bool is_within(const struct rg_claim *c, int row)
{
    return row >= c->knee && row <= (c->until ? c->until : c->knee);
}

// Each row outside the range must be slower than the fastest within, of the same launch.
static void make_optimum(const struct evidence *e, struct rg_claim_parts *p)
{
    for (int r = 0; r < e->count; r++) {
        if (is_within(e->claim, e->rows[r]) ||
            !add(p, (struct rg_claim_part){.slow = r}, 0, INFINITY))
            continue;
        for (int l = 0; l < e->launches; l++) {
            double fastest = INFINITY;
            for (int i = 0; i < e->count; i++) {
                const bool is_faster =
                    is_within(e->claim, e->rows[i]) && e->logs[l][i][0] < fastest;
                fastest = is_faster ? e->logs[l][i][0] : fastest;
                p->of[p->count - 1].fast = is_faster ? i : p->of[p->count - 1].fast;
            }
            p->values[p->count - 1][l] = e->logs[l][r][0] - fastest;
        }
    }
}

static void make_rate(const struct evidence *e, struct rg_claim_parts *p)
{
    for (int i = 0; i < e->count; i++) {
        if (!add(p, (struct rg_claim_part){.slow = i, .fast = -1}, log(e->claim->least), INFINITY))
            return;
        for (int l = 0; l < e->launches; l++)
            p->values[p->count - 1][l] = log(1000) - e->logs[l][i][0];
    }
}

static double axis_at(const struct evidence *e, int row)
{
    const struct rg_record *r = rg_evidence_row(e, row);
    for (int i = 0; i < r->row_count; i++)
        if (!*r->row[i].text)
            return r->row[i].number;
    return NAN;
}

// The slope of the logarithm of the frame rate, over the whole axis. So it is the logarithm of a
// ratio, like the values of other parts.
static void make_exponent(const struct evidence *e, struct rg_claim_parts *p)
{
    struct rg_slope_point points[RG_CLAIM_ROWS];
    double weights[RG_CLAIM_ROWS], low = INFINITY, high = -INFINITY;
    for (int i = 0; i < e->count; i++) {
        points[i] = (struct rg_slope_point){.x = log(axis_at(e, e->rows[i]))};
        low = fmin(low, points[i].x);
        high = fmax(high, points[i].x);
    }
    rg_slope_weights(points, e->count, weights);
    p->scale = high - low;
    if (isnan(weights[0]) || !add(p, (struct rg_claim_part){.fast = -1}, e->claim->least * p->scale,
                                  e->claim->most * p->scale))
        return;
    for (int l = 0; l < e->launches; l++) {
        double slope = 0;
        for (int i = 0; i < e->count; i++)
            slope -= weights[i] * e->logs[l][i][0];
        p->values[0][l] = slope * p->scale;
    }
}

static void make(const struct evidence *e, struct rg_claim_parts *p)
{
    const struct rg_claim *c = e->claim;
    switch (c->test) {
    case RG_CLAIM_FALLS:
        make_falls(e, p);
        break;
    case RG_CLAIM_ORDER:
        make_order(e, p);
        break;
    case RG_CLAIM_RATIO:
    case RG_CLAIM_TIMES:
        add_rows(e, p, 0, 1, c->least, c->test == RG_CLAIM_TIMES ? c->most : INFINITY);
        break;
    case RG_CLAIM_ALIKE:
        make_alike(e, p, c->most);
        break;
    case RG_CLAIM_APART:
        make_alike(e, p, c->least);
        p->join = RG_SETTLE_ANY;
        break;
    case RG_CLAIM_EXPONENT:
        make_exponent(e, p);
        break;
    case RG_CLAIM_FASTER:
        for (int i = 0; i < e->count; i++)
            add_variants(e, p, i, 0, c->least);
        break;
    case RG_CLAIM_RATE:
        make_rate(e, p);
        break;
    case RG_CLAIM_OPTIMUM:
        make_optimum(e, p);
        break;
    case RG_CLAIM_SLOWEST:
        make_slowest(e, p);
        break;
    case RG_CLAIM_CROSSES:
        make_crosses(e, p);
        break;
    case RG_CLAIM_FLATTENS:
        break; // no times
    }
}

bool rg_claim_parts_make(const struct evidence *e, struct rg_claim_parts *p)
{
    p->join = RG_SETTLE_ALL;
    p->count = 0;
    p->scale = 1;
    make(e, p);
    return p->count > 0;
}

// --- telling ---

enum { NAME_SIZE = 160 };

static void name_cell(const struct evidence *e, int i, char name[NAME_SIZE])
{
    rg_record_row_name(rg_evidence_row(e, e->rows[i]), name, NAME_SIZE);
}

static const char *variant_name(const struct evidence *e, int variant)
{
    return e->result->variants[variant ? e->other : e->at.variant];
}

// What the part compares, before and after its value: "size 1 is ", " as size 5".
struct compared {
    char before[2 * NAME_SIZE], after[NAME_SIZE + 8];
};

static void name_part(const struct evidence *e, const struct rg_claim_part *of,
                      struct compared *text)
{
    static const char *const abouts[] = {
        [RG_PART_ROWS] = "", [RG_PART_WHOLE_FALL] = "in all ", [RG_PART_TREND] = "by the trend "};
    char slow[NAME_SIZE], fast[NAME_SIZE];
    name_cell(e, of->slow, slow);
    *text = (struct compared){0};
    if (e->claim->test == RG_CLAIM_EXPONENT) {
        snprintf(text->before, sizeof(text->before), "the power is ");
    } else if (of->fast < 0) {
        snprintf(text->before, sizeof(text->before), "%s: ", slow);
    } else if (of->fast_variant != of->slow_variant) {
        snprintf(text->before, sizeof(text->before), "%s, %s is ", slow,
                 variant_name(e, of->fast_variant));
        snprintf(text->after, sizeof(text->after), " as %s", variant_name(e, of->slow_variant));
    } else {
        name_cell(e, of->fast, fast);
        snprintf(text->before, sizeof(text->before), "%s%s is ", abouts[of->about], fast);
        snprintf(text->after, sizeof(text->after), " as %s", slow);
    }
}

// A part's value for readers: a ratio, a frame rate or a power.
static double shown(const struct rg_claim_parts *p, double value, bool is_power)
{
    return is_power ? value / p->scale : exp(value);
}

// "at least 1.2", "0.95 to 1.05". Between neighbouring rows of a fall the bound is the tolerance.
static void name_needed(const struct rg_claim_parts *p, int part, enum rg_claim_test test,
                        char *text, size_t size)
{
    const bool is_power = test == RG_CLAIM_EXPONENT;
    const double least = p->parts[part].least, most = p->parts[part].most;
    const double low = shown(p, least, is_power), high = shown(p, most, is_power);
    if (isfinite(least) && isfinite(most))
        snprintf(text, size, "%.3g to %.3g", low, high);
    else if (isfinite(most))
        snprintf(text, size, "at most %.3g", high);
    else if (test == RG_CLAIM_FALLS && p->of[part].about == RG_PART_ROWS)
        snprintf(
            text, size,
            "at least %.3g, or 1/%.3g, since a row may be %.3g times as fast as the row before",
            low, RG_CLAIM_REVERSAL, RG_CLAIM_REVERSAL);
    else
        snprintf(text, size, "at least %.3g", low);
}

void rg_claim_part_tell(const struct evidence *e, const struct rg_claim_parts *p, int part,
                        const struct rg_interval *of, char *text, size_t size)
{
    const bool is_power = e->claim->test == RG_CLAIM_EXPONENT;
    const char *unit = is_power ? "" : e->claim->test == RG_CLAIM_RATE ? " fps" : " times as fast";
    struct compared about;
    char needed[128], interval[64] = "";
    name_part(e, &p->of[part], &about);
    name_needed(p, part, e->claim->test, needed, sizeof(needed));
    if (isfinite(of->low) && isfinite(of->high))
        snprintf(interval, sizeof(interval), " (%.3g to %.3g)", shown(p, of->low, is_power),
                 shown(p, of->high, is_power));
    snprintf(text, size, "%s%.3g%s%s%s, needed: %s", about.before, shown(p, of->median, is_power),
             unit, about.after, interval, needed);
}
