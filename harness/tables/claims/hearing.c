#include "harness/tables/claims/hearing.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

struct rg_judgement rg_hearing_end(struct hearing *h, enum rg_claim_verdict verdict,
                                   const char *why, ...)
{
    va_list arguments;
    va_start(arguments, why);
    vsnprintf(h->judgement.why, sizeof(h->judgement.why), why, arguments);
    va_end(arguments);
    h->judgement.verdict = verdict;
    return h->judgement;
}

const struct rg_record *rg_hearing_row_of(const struct hearing *h, int row, int variant)
{
    struct rg_place at = h->at;
    at.row = row - 1;
    at.variant = variant;
    return rg_result_at(h->result, at);
}

const struct rg_record *rg_hearing_row(const struct hearing *h, int row)
{
    return rg_hearing_row_of(h, row, h->at.variant);
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

static bool is_of_errors(const struct hearing *h)
{
    return h->claim->test == RG_CLAIM_FLATTENS;
}

static bool has_row(const struct hearing *h, int row)
{
    return row > h->result->first_row && row <= h->result->last_row + 1 &&
           rg_result_has(h->result, row - 1);
}

static bool has_number(const struct hearing *h, int row, int variant)
{
    if (!has_row(h, row))
        return false;
    const struct rg_record *r = rg_hearing_row_of(h, row, variant);
    return is_of_errors(h) ? r->truth_error.outcome == RG_OK && *h->result->truth
                           : r->outcome == RG_OK && r->sample_count > 0;
}

// The least samples of both variants in a row.
static int fewest_samples(const struct hearing *h, int row)
{
    const int count = rg_hearing_row(h, row)->sample_count;
    const int other = h->other < 0 ? count : rg_hearing_row_of(h, row, h->other)->sample_count;
    return count < other ? count : other;
}

// The failed record of a measured row, of either variant; NULL where there is none.
static const struct rg_record *failed(const struct hearing *h, int row)
{
    const struct rg_record *r = has_row(h, row) ? rg_hearing_row(h, row) : NULL;
    if (r && r->outcome == RG_OK && h->other >= 0)
        r = rg_hearing_row_of(h, row, h->other);
    return r && r->outcome != RG_OK ? r : NULL;
}

// Ends with the reason why a row has no number. Returns false.
static bool end_without_number(struct hearing *h, int row)
{
    const struct rg_record *r = failed(h, row);
    if (r)
        rg_hearing_end(h, RG_CLAIM_UNDECIDED, "row %d has no number: %.180s", row, r->detail);
    else if (is_of_errors(h) && has_row(h, row))
        rg_hearing_end(h, RG_CLAIM_UNDECIDED, "row %d has no error: %.180s", row,
                       rg_hearing_row(h, row)->truth_error.detail);
    else
        rg_hearing_end(h, RG_CLAIM_UNDECIDED, "row %d is not measured", row);
    return false;
}

// Whether a claim can be judged without a row: those between the first and the last, except a knee.
static bool can_miss(const struct rg_claim *c, int row)
{
    return rg_claim_is_of_each_row(c) || (row != c->first && row != c->last && row != c->knee);
}

int rg_hearing_step(const struct rg_claim *c)
{
    return c->test == RG_CLAIM_RATIO ? c->last - c->first : 1;
}

// Collects the claim's rows, without those that did other work. Ends where required ones are
// missing or did other work; true if the claim can be judged.
static bool hear_rows(struct hearing *h)
{
    const struct rg_claim *c = h->claim;
    const int step = rg_hearing_step(c);
    for (int row = c->first; step > 0 ? row <= c->last : row >= c->last; row += step) {
        if (!has_number(h, row, h->at.variant) ||
            (h->other >= 0 && !has_number(h, row, h->other))) {
            h->missing++;
            if (can_miss(c, row))
                continue;
            return end_without_number(h, row);
        }
        const int fewest = fewest_samples(h, row);
        if (fewest < RG_LEAST_SAMPLES && !is_of_errors(h)) {
            h->missing++;
            if (can_miss(c, row))
                continue;
            rg_hearing_end(h, RG_CLAIM_UNDECIDED, "row %d has %d samples, and 6 are needed", row,
                           fewest);
            return false;
        }
        double apart;
        if (rg_record_is_other_work(rg_hearing_row(h, row), &apart)) {
            if (can_miss(c, row))
                continue;
            rg_hearing_end(h, RG_CLAIM_OTHER_WORK,
                           "row %d draws %.2f times as many or as few particles", row, apart);
            return false;
        }
        h->rows[h->count++] = row;
    }
    h->judgement.rows = is_of_errors(h) ? ERROR_ROWS : h->count;
    return h->count > 0 || end_without_number(h, c->first);
}

static void find(struct hearing *h)
{
    const struct rg_claim *c = h->claim;
    h->at.work = rg_result_printed_work(h->result);
    h->at.variant = variant_of(h->result, c->variant);
    h->other = variant_of(h->result, c->other);
    h->judgement.against = h->judgement.in_favour = NAN;
    h->judgement.rows_needed =
        is_of_errors(h) ? ERROR_ROWS : 1 + (c->last - c->first) / rg_hearing_step(c);
}

bool rg_hearing_begin(struct hearing *h)
{
    const struct rg_claim *claim = h->claim;
    find(h);
    if (*h->result->changed) {
        rg_hearing_end(h, RG_CLAIM_OTHER_WORK, "settings were changed: %.100s", h->result->changed);
        return false;
    }
    if (claim->test == RG_CLAIM_RATE && h->result->size_divisor > 1) {
        rg_hearing_end(h, RG_CLAIM_OTHER_WORK,
                       "pictures have 1/%d of the width and height that the rate is claimed of",
                       h->result->size_divisor);
        return false;
    }
    if (h->at.work < 0) {
        rg_hearing_end(h, RG_CLAIM_OTHER_WORK, "the work that was printed is not measured");
        return false;
    }
    if (h->at.variant < 0 || (claim->other && h->other < 0)) {
        rg_hearing_end(h, RG_CLAIM_UNDECIDED, "variant %s is not measured",
                       h->at.variant < 0 ? claim->variant : claim->other);
        return false;
    }
    return hear_rows(h);
}
