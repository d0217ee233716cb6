// Verdicts on the claims of all papers, on one screen.
#ifndef RG_HARNESS_TABLES_CLAIMS_TEXT_H
#define RG_HARNESS_TABLES_CLAIMS_TEXT_H

#include "harness/console/sheet.h"
#include "harness/tables/claims/claim.h"

enum { RG_CLAIMS_LENGTH = RG_TITLE_SIZE + 64 };

// A claim's verdict on one device.
struct rg_claim_outcome {
    const struct rg_claim *claim;
    char device[RG_NAME_SIZE];
    // The length of the judged measurement: "full", or "quick (atlas=small), with 1/4 of the width
    // and height".
    char length[RG_CLAIMS_LENGTH];
    struct rg_judgement judgement;
};

struct rg_claim_outcomes {
    int count;
    int64_t room;                      // capacity, for rg_array_fit
    struct rg_claim_outcome *outcomes; // owned; a claim's are contiguous
    json_t *tables;                    // owned; the JSON description of each judged table
};

// "full", or "quick" with its settings, either with the ratio of the pictures' size to the table's.
void rg_claims_length(const struct rg_result *result, char *text, size_t size);

// Adds the outcomes of a table's claims. Zero the outcomes before the first call. False, with one
// logged line, when memory runs out.
bool rg_claims_add(struct rg_claim_outcomes *outcomes, const struct rg_result *result);
void rg_claims_free(struct rg_claim_outcomes *outcomes);

// Makes a row for each claim and a column for each device. Notes list the lengths of measurements
// by table, claims judged by some of their rows, and claims that the paper's own table contradicts.
// `wide` adds verdicts in words, with section, reason and p value; otherwise the page fits a
// screen. Zero the sheet before; the caller frees it.
void rg_claims_sheet(const struct rg_claim_outcomes *outcomes, bool wide, struct rg_sheet *sheet);

#endif
