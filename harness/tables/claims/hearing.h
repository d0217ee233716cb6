// A claim before a result: which cells it is about. For the files of this folder alone.
#ifndef RG_HARNESS_TABLES_CLAIMS_HEARING_H
#define RG_HARNESS_TABLES_CLAIMS_HEARING_H

#include "harness/tables/claims/claim.h"

// A claim about a result: the work that was printed, and its variants.
struct hearing {
    const struct rg_claim *claim;
    const struct rg_result *result;
    struct rg_place at;
    int other;                       // the second variant's index
    int count, rows[RG_RESULT_ROWS]; // those that are measured, from 1
    int missing;                     // that have no number, or too few samples
    struct rg_judgement judgement;
};

// Finds the work, the variants and the rows. False where the hearing ends with that.
bool rg_hearing_begin(struct hearing *h);
// Ends it with a verdict and one sentence.
struct rg_judgement rg_hearing_end(struct hearing *h, enum rg_claim_verdict verdict,
                                   const char *why, ...) __attribute__((format(printf, 3, 4)));
// A row's record, of the variant that the claim is about, or of another.
const struct rg_record *rg_hearing_row(const struct hearing *h, int row);
const struct rg_record *rg_hearing_row_of(const struct hearing *h, int row, int variant);
// From one of the claim's rows to the next: of a ratio there are two.
int rg_hearing_step(const struct rg_claim *claim);
// Whether the paper's own numbers speak against the claim, whatever was measured of its rows. Where
// it prints none, they do not.
bool rg_hearing_print_contradicts(const struct hearing *h);

// How far a ratio that the claim reads off its table can be from that of the rows' own rates, as a
// share: by the rounding of both numbers. 0 of an order, and where nothing is printed.
double rg_hearing_margin(const struct hearing *h);

#endif
