#include "harness/tables/claims/evidence.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "harness/tables/papers/papers.h"

struct rg_judgement rg_evidence_end(struct evidence *e, enum rg_claim_verdict verdict,
                                    const char *why, ...)
{
    va_list arguments;
    va_start(arguments, why);
    vsnprintf(e->judgement.why, sizeof(e->judgement.why), why, arguments);
    va_end(arguments);
    e->judgement.verdict = verdict;
    return e->judgement;
}

const struct rg_record *rg_evidence_row_of(const struct evidence *e, int row, int variant)
{
    struct rg_place at = e->at;
    at.row = row - 1;
    at.variant = variant;
    return rg_result_at(e->result, at);
}

const struct rg_record *rg_evidence_row(const struct evidence *e, int row)
{
    return rg_evidence_row_of(e, row, e->at.variant);
}

// --- required rows ---

enum { ERROR_ROWS = 3 }; // rows of a knee: the first, itself, and the last

static int variant_of(const struct rg_result *result, const char *name)
{
    for (int i = 0; name && i < result->variant_count; i++)
        if (!strcmp(result->variants[i], name))
            return i;
    return -1;
}

static bool is_of_errors(const struct evidence *e)
{
    return e->claim->test == RG_CLAIM_FLATTENS;
}

// A claim about two or three rows needs only these. `step` is 0 after the last.
static int row_after(const struct rg_claim *c, int row)
{
    if (c->test == RG_CLAIM_FLATTENS)
        return row < c->knee ? c->knee : row < c->last ? c->last : 0;
    if (c->test == RG_CLAIM_RATIO || c->test == RG_CLAIM_TIMES)
        return row == c->last ? 0 : c->last;
    return row < c->last ? row + 1 : 0;
}

bool rg_claim_needs(const struct rg_claim *c, int row, const char *variant)
{
    bool is_row = false;
    for (int r = c->first; r; r = row_after(c, r))
        is_row = is_row || r == row;
    return is_row && (!strcmp(variant, c->variant) || (c->other && !strcmp(variant, c->other)));
}

static bool has_row(const struct evidence *e, int row)
{
    return row > e->result->first_row && row <= e->result->last_row + 1 &&
           rg_result_has(e->result, row - 1);
}

// Ends with the reason why a row has no number, and returns false; true if it has one.
static bool has_number(struct evidence *e, int row, int variant)
{
    if (!has_row(e, row)) {
        rg_evidence_end(e, RG_CLAIM_NOT_SEEN, "row %d is not measured", row);
        return false;
    }
    const struct rg_record *r = rg_evidence_row_of(e, row, variant);
    const bool has_error = r->truth_error.outcome == RG_OK && *e->result->truth;
    const bool has = is_of_errors(e) ? has_error : r->outcome == RG_OK && r->sample_count > 0;
    if (!has && r->outcome != RG_OK)
        rg_evidence_end(e, RG_CLAIM_NOT_SEEN, "row %d has no number: %.180s", row, r->detail);
    else if (!has && is_of_errors(e))
        rg_evidence_end(e, RG_CLAIM_NOT_SEEN, "row %d has no error: %.180s", row,
                        r->truth_error.detail);
    else if (!has)
        rg_evidence_end(e, RG_CLAIM_NOT_SEEN, "row %d is not measured", row);
    return has;
}

// Whether a row that did other work may be left out: not at the ends, and no knee.
static bool can_miss(const struct rg_claim *c, int row)
{
    return row != c->first && row != c->last && row != c->knee;
}

// Collects the claim's rows, without those between that did other work. Ends with a verdict if rows
// are missing or required ones did other work; true if the claim can be judged.
static bool collect_rows(struct evidence *e)
{
    const struct rg_claim *c = e->claim;
    for (int row = c->first; row; row = row_after(c, row)) {
        double apart;
        e->judgement.rows_needed++;
        if (!has_number(e, row, e->at.variant) || (e->other >= 0 && !has_number(e, row, e->other)))
            return false;
        if (!rg_record_is_other_work(rg_evidence_row(e, row), &apart)) {
            e->rows[e->count++] = row;
        } else if (!can_miss(c, row)) {
            rg_evidence_end(e, RG_CLAIM_OTHER_WORK,
                            "row %d draws %.2f times as many or as few particles", row, apart);
            return false;
        }
    }
    e->judgement.rows = e->count;
    return true;
}

// Whether the result's work differs from the one for which the paper gives a rate.
static bool is_reduced(struct evidence *e)
{
    const struct rg_result *result = e->result;
    if (e->claim->test != RG_CLAIM_RATE)
        return false;
    if (result->size_divisor > 1)
        rg_evidence_end(e, RG_CLAIM_OTHER_WORK,
                        "pictures have 1/%d of the width and height that the rate is claimed of",
                        result->size_divisor);
    else if (!result->full && *result->quick)
        rg_evidence_end(e, RG_CLAIM_OTHER_WORK,
                        "quick settings are less work than the rate is claimed of: %.100s",
                        result->quick);
    return e->judgement.verdict == RG_CLAIM_OTHER_WORK;
}

bool rg_evidence_begin(struct evidence *e)
{
    const struct rg_claim *claim = e->claim;
    e->at.work = rg_result_printed_work(e->result);
    e->at.variant = variant_of(e->result, claim->variant);
    e->other = variant_of(e->result, claim->other);
    e->judgement.figures = RG_FIGURES_NONE;
    if (*e->result->changed) {
        rg_evidence_end(e, RG_CLAIM_OTHER_WORK, "settings were changed: %.100s",
                        e->result->changed);
        return false;
    }
    if (is_reduced(e))
        return false;
    if (e->at.work < 0) {
        rg_evidence_end(e, RG_CLAIM_OTHER_WORK, "the work that was printed is not measured");
        return false;
    }
    if (e->at.variant < 0 || (claim->other && e->other < 0)) {
        rg_evidence_end(e, RG_CLAIM_NOT_SEEN, "variant %s is not measured",
                        e->at.variant < 0 ? claim->variant : claim->other);
        return false;
    }
    return collect_rows(e);
}

// --- times ---

static const struct rg_record *cell(const struct evidence *e, int i, int variant)
{
    return rg_evidence_row_of(e, e->rows[i], variant ? e->other : e->at.variant);
}

static const struct rg_launch *find_launch(const struct rg_record *record, int number)
{
    int low = 0, high = record->launch_count;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (record->launches[middle].number < number)
            low = middle + 1;
        else
            high = middle;
    }
    const bool has = low < record->launch_count && record->launches[low].number == number;
    return has ? &record->launches[low] : NULL;
}

// Takes a launch if it has all cells of the claim, and counts it if others disturbed it.
static void take_launch(struct evidence *e, int number)
{
    bool is_disturbed = false;
    double seconds = 0;
    for (int i = 0; i < e->count; i++) {
        for (int v = 0; v < 1 + (e->other >= 0); v++) {
            const struct rg_launch *launch = find_launch(cell(e, i, v), number);
            if (!launch)
                return;
            is_disturbed = is_disturbed || rg_launch_is_disturbed(launch);
            e->logs[e->launches][i][v] = log(launch->ms);
            seconds += launch->seconds;
        }
    }
    e->launches += !is_disturbed;
    e->judgement.disturbed += is_disturbed;
    e->judgement.launch_s += seconds;
}

bool rg_evidence_take_launches(struct evidence *e)
{
    const struct rg_record *first = cell(e, 0, 0);
    for (int i = 0; i < first->launch_count; i++)
        take_launch(e, first->launches[i].number);
    const int taken = e->launches + e->judgement.disturbed;
    e->judgement.launches = e->launches;
    e->judgement.launch_s /= taken ? taken : 1;
    return taken > 0;
}

void rg_evidence_take_medians(struct evidence *e)
{
    e->launches = 1;
    for (int i = 0; i < e->count; i++)
        for (int v = 0; v < 1 + (e->other >= 0); v++)
            e->logs[0][i][v] = log(cell(e, i, v)->frame_ms.median);
}

// --- print ---

// Takes the rows from the table, if there is one, since unmeasured rows are printed all the same.
double rg_evidence_printed(const struct evidence *e, int row, int variant)
{
    const struct rg_table *table = rg_table_find(e->claim->table);
    const int index = variant ? e->other : e->at.variant;
    const char *name = e->result->variants[index];
    for (int v = 0; table && table->variants[v].name; v++)
        if (!strcmp(table->variants[v].name, name))
            return rg_table_published_fps(table, row - 1, v);
    return rg_result_has(e->result, row - 1)
               ? rg_record_published_fps(rg_evidence_row_of(e, row, index))
               : NAN;
}

// Takes a printed row as a launch's; false if it is not printed.
static bool take_printed_row(struct evidence *e, int row)
{
    bool is_printed = true;
    for (int v = 0; v < 1 + (e->other >= 0); v++) {
        const double fps = rg_evidence_printed(e, row, v);
        e->logs[0][e->count][v] = log(1000 / fps);
        is_printed = is_printed && isfinite(fps);
    }
    if (is_printed)
        e->rows[e->count++] = row;
    return is_printed;
}

bool rg_evidence_take_print(struct evidence *e)
{
    const struct rg_claim *c = e->claim;
    bool ok = e->at.variant >= 0 && (!c->other || e->other >= 0) && !is_of_errors(e);
    e->at.work = e->at.work < 0 ? 0 : e->at.work; // all works have the same printed numbers
    e->launches = 1;
    e->count = 0;
    for (int row = c->first; ok && row; row = row_after(c, row))
        ok = take_printed_row(e, row) || can_miss(c, row);
    return ok;
}
