// The evidence for a claim in a result: its cells. For the files of this folder alone.
#ifndef RG_HARNESS_TABLES_CLAIMS_EVIDENCE_H
#define RG_HARNESS_TABLES_CLAIMS_EVIDENCE_H

#include "harness/judge/settle.h"
#include "harness/tables/claims/claim.h"

enum { RG_CLAIM_ROWS = 18 }; // at most, of a claim

// A claim and a result, with the printed work and the claim's variants.
struct evidence {
    const struct rg_claim *claim;
    const struct rg_result *result;
    struct rg_place at;
    int other;                      // index of the second variant; -1: none
    int count, rows[RG_CLAIM_ROWS]; // rows that are judged, from 1
    // Logarithms of the time of a frame, by launch, row and variant. Launches that others disturbed
    // are left out. One launch: the medians of the result's samples.
    int launches;
    double logs[RG_MAX_LAUNCHES][RG_CLAIM_ROWS][2];
    struct rg_judgement judgement;
};

// Finds the work, the variants and the rows. False if that already decides the verdict.
bool rg_evidence_begin(struct evidence *e);
// Takes the logarithms of all launches; false if there are none. Then of the medians.
bool rg_evidence_take_launches(struct evidence *e);
void rg_evidence_take_medians(struct evidence *e);
// Takes the printed frame rates of all rows as a launch's. False if a variant is missing, or
// nothing is printed.
bool rg_evidence_take_print(struct evidence *e);
// Ends with a verdict and one sentence.
struct rg_judgement rg_evidence_end(struct evidence *e, enum rg_claim_verdict verdict,
                                    const char *why, ...) __attribute__((format(printf, 3, 4)));
// The record of a row, for the claim's variant or another one.
const struct rg_record *rg_evidence_row(const struct evidence *e, int row);
const struct rg_record *rg_evidence_row_of(const struct evidence *e, int row, int variant);
// The printed frame rate of a row, measured or not, for the claim's variant (0) or the other one
// (1); NAN if there is none.
double rg_evidence_printed(const struct evidence *e, int row, int variant);

// --- parts ---

enum { RG_CLAIM_PARTS = RG_CLAIM_ROWS * (RG_CLAIM_ROWS - 1) / 2 };

// A claim as parts that launches settle. A part compares the times of two cells, or is about one.
struct rg_claim_parts {
    enum rg_settle_join join;
    double scale; // by which a power is multiplied, to be the logarithm of a ratio; else 1
    int count;
    struct rg_settle_part parts[RG_CLAIM_PARTS];
    struct rg_claim_part {
        int slow, fast;                 // indices of rows; fast -1: about one cell, or all
        int slow_variant, fast_variant; // 0: the claim's, 1: the other
        enum { RG_PART_ROWS, RG_PART_WHOLE_FALL, RG_PART_TREND } about;
    } of[RG_CLAIM_PARTS];
    double values[RG_CLAIM_PARTS][RG_MAX_LAUNCHES];
};
// Makes the claim's parts from the evidence's logarithms. False: there is nothing to compare.
bool rg_claim_parts_make(const struct evidence *e, struct rg_claim_parts *parts);
// Writes one sentence about a part: its rows, its median with its interval (ends NAN: none), and
// the bounds.
void rg_claim_part_tell(const struct evidence *e, const struct rg_claim_parts *parts, int part,
                        const struct rg_interval *of, char *text, size_t size);

#endif
