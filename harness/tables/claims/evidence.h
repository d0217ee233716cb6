// The evidence for a claim in a result: its cells. For the files of this folder alone.
#ifndef RG_HARNESS_TABLES_CLAIMS_EVIDENCE_H
#define RG_HARNESS_TABLES_CLAIMS_EVIDENCE_H

#include "harness/tables/claims/claim.h"

// A claim and a result, with the printed work and the claim's variants.
struct evidence {
    const struct rg_claim *claim;
    const struct rg_result *result;
    struct rg_place at;
    int other;                       // index of the second variant
    int count, rows[RG_RESULT_ROWS]; // measured rows, from 1
    int missing;                     // rows without a number, or with too few samples
    struct rg_judgement judgement;
};

// Finds the work, the variants and the rows. False where that already decides the verdict.
bool rg_evidence_begin(struct evidence *e);
// Ends with a verdict and one sentence.
struct rg_judgement rg_evidence_end(struct evidence *e, enum rg_claim_verdict verdict,
                                    const char *why, ...) __attribute__((format(printf, 3, 4)));
// The record of a row, for the claim's variant or another one.
const struct rg_record *rg_evidence_row(const struct evidence *e, int row);
const struct rg_record *rg_evidence_row_of(const struct evidence *e, int row, int variant);
// The step between the claim's rows: a ratio has only two.
int rg_evidence_step(const struct rg_claim *claim);
// Whether the paper's own numbers contradict the claim, whatever was measured. Without printed
// numbers they do not.
bool rg_evidence_print_contradicts(const struct evidence *e);

// The relative error of a ratio that the claim reads off its table, from the rounding of both
// printed numbers. 0 for an order, and where nothing is printed.
double rg_evidence_margin(const struct evidence *e);

#endif
