#include "harness/tables/claims/evidence.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

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

static bool has_row(const struct evidence *e, int row)
{
    return row > e->result->first_row && row <= e->result->last_row + 1 &&
           rg_result_has(e->result, row - 1);
}

static bool has_number(const struct evidence *e, int row, int variant)
{
    if (!has_row(e, row))
        return false;
    const struct rg_record *r = rg_evidence_row_of(e, row, variant);
    return is_of_errors(e) ? r->truth_error.outcome == RG_OK && *e->result->truth
                           : r->outcome == RG_OK && r->sample_count > 0;
}

// The least samples of both variants in a row.
static int fewest_samples(const struct evidence *e, int row)
{
    const int count = rg_evidence_row(e, row)->sample_count;
    const int other = e->other < 0 ? count : rg_evidence_row_of(e, row, e->other)->sample_count;
    return count < other ? count : other;
}

// The failed record of a measured row, of either variant; NULL where there is none.
static const struct rg_record *failed(const struct evidence *e, int row)
{
    const struct rg_record *r = has_row(e, row) ? rg_evidence_row(e, row) : NULL;
    if (r && r->outcome == RG_OK && e->other >= 0)
        r = rg_evidence_row_of(e, row, e->other);
    return r && r->outcome != RG_OK ? r : NULL;
}

// Ends with the reason why a row has no number. Returns false.
static bool end_without_number(struct evidence *e, int row)
{
    const struct rg_record *r = failed(e, row);
    if (r)
        rg_evidence_end(e, RG_CLAIM_UNDECIDED, "row %d has no number: %.180s", row, r->detail);
    else if (is_of_errors(e) && has_row(e, row))
        rg_evidence_end(e, RG_CLAIM_UNDECIDED, "row %d has no error: %.180s", row,
                        rg_evidence_row(e, row)->truth_error.detail);
    else
        rg_evidence_end(e, RG_CLAIM_UNDECIDED, "row %d is not measured", row);
    return false;
}

// Whether a claim can be judged without a row. If it is about each row, any may be missing; else
// those between the first and the last, except a knee.
static bool can_miss(const struct rg_claim *c, int row)
{
    return rg_claim_is_of_each_row(c) || (row != c->first && row != c->last && row != c->knee);
}

int rg_evidence_step(const struct rg_claim *c)
{
    return c->test == RG_CLAIM_RATIO ? c->last - c->first : 1;
}

// Collects the claim's rows, without those that did other work. Ends where required ones are
// missing or did other work; true if the claim can be judged.
static bool collect_rows(struct evidence *e)
{
    const struct rg_claim *c = e->claim;
    const int step = rg_evidence_step(c);
    for (int row = c->first; step > 0 ? row <= c->last : row >= c->last; row += step) {
        if (!has_number(e, row, e->at.variant) ||
            (e->other >= 0 && !has_number(e, row, e->other))) {
            e->missing++;
            if (can_miss(c, row))
                continue;
            return end_without_number(e, row);
        }
        const int fewest = fewest_samples(e, row);
        if (fewest < RG_LEAST_SAMPLES && !is_of_errors(e)) {
            e->missing++;
            if (can_miss(c, row))
                continue;
            rg_evidence_end(e, RG_CLAIM_UNDECIDED, "row %d has %d samples, and 6 are needed", row,
                            fewest);
            return false;
        }
        double apart;
        if (rg_record_is_other_work(rg_evidence_row(e, row), &apart)) {
            if (can_miss(c, row))
                continue;
            rg_evidence_end(e, RG_CLAIM_OTHER_WORK,
                            "row %d draws %.2f times as many or as few particles", row, apart);
            return false;
        }
        e->rows[e->count++] = row;
    }
    e->judgement.rows = is_of_errors(e) ? ERROR_ROWS : e->count;
    return e->count > 0 || end_without_number(e, c->first);
}

static void find(struct evidence *e)
{
    const struct rg_claim *c = e->claim;
    e->at.work = rg_result_printed_work(e->result);
    e->at.variant = variant_of(e->result, c->variant);
    e->other = variant_of(e->result, c->other);
    e->judgement.against = e->judgement.in_favour = NAN;
    e->judgement.rows_needed =
        is_of_errors(e) ? ERROR_ROWS : 1 + (c->last - c->first) / rg_evidence_step(c);
}

bool rg_evidence_begin(struct evidence *e)
{
    const struct rg_claim *claim = e->claim;
    find(e);
    if (*e->result->changed) {
        rg_evidence_end(e, RG_CLAIM_OTHER_WORK, "settings were changed: %.100s",
                        e->result->changed);
        return false;
    }
    if (claim->test == RG_CLAIM_RATE && e->result->size_divisor > 1) {
        rg_evidence_end(e, RG_CLAIM_OTHER_WORK,
                        "pictures have 1/%d of the width and height that the rate is claimed of",
                        e->result->size_divisor);
        return false;
    }
    if (e->at.work < 0) {
        rg_evidence_end(e, RG_CLAIM_OTHER_WORK, "the work that was printed is not measured");
        return false;
    }
    if (e->at.variant < 0 || (claim->other && e->other < 0)) {
        rg_evidence_end(e, RG_CLAIM_UNDECIDED, "variant %s is not measured",
                        e->at.variant < 0 ? claim->variant : claim->other);
        return false;
    }
    return collect_rows(e);
}
