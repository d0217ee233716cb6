// Verdicts on the claims of all papers, on one screen.
#ifndef RG_HARNESS_TABLES_CLAIMS_SHEET_H
#define RG_HARNESS_TABLES_CLAIMS_SHEET_H

#include "harness/console/sheet.h"
#include "harness/tables/claims/claim.h"

enum { RG_CLAIMS_LENGTH = RG_TITLE_SIZE + 64 };

// A claim's verdict on one device.
struct rg_claim_outcome {
    const struct rg_claim *claim;
    char device[RG_NAME_SIZE];
    // Of what was judged: "full", or "quick (atlas=small), with 1/4 of the width and height".
    char length[RG_CLAIMS_LENGTH];
    struct rg_judgement judgement;
};

struct rg_claim_outcomes {
    int count;
    int64_t room;                      // for rg_array_fit
    struct rg_claim_outcome *outcomes; // owned; all of a claim follow each other
    json_t *tables; // owned; what each table that was judged is of, as its own document has it
};

// "full", "quick" with what that sets, or either with the share that pictures have of the table's
// width and height.
void rg_claims_length(const struct rg_result *result, char *text, size_t size);

// Adds the outcomes of the claims about a result's table. The outcomes are zeroed before the first.
// False, with one logged line, without memory.
bool rg_claims_add(struct rg_claim_outcomes *outcomes, const struct rg_result *result);
void rg_claims_free(struct rg_claim_outcomes *outcomes);

// A row each claim, a column each device, and below how long what was judged was measured, by
// table, which claims were judged by some of their rows, and which the paper's own table
// contradicts. `wide`: verdicts in words, with the section and with the reason and the probability
// of each; else a page of one screen. The sheet is zeroed before, and the caller frees it.
void rg_claims_sheet(const struct rg_claim_outcomes *outcomes, bool wide, struct rg_sheet *sheet);

#endif
