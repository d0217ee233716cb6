// Verdicts on the claims of all papers, on one screen.
#ifndef RG_HARNESS_TABLES_CLAIMS_TEXT_H
#define RG_HARNESS_TABLES_CLAIMS_TEXT_H

#include "harness/console/sheet.h"
#include "harness/tables/claims/outcomes.h"

// Makes a row for each claim and machine and a column for each device, below one sentence and the
// totals: how many claims hold, do not hold, and are open. Notes name the machines if there are
// several, with the verdicts that differ between them, and list the lengths of measurements by
// table, and three kinds of claims: judged by some of their rows, contradicted by the paper's own
// table, and different by today's figures. `wide` adds verdicts in words, with section and reason;
// otherwise the page fits a screen. Zero the sheet before; the caller frees it.
void rg_claims_sheet(const struct rg_claim_outcomes *outcomes, bool wide, struct rg_sheet *sheet);

// Adds the sentence and the totals: the sheet's lead.
void rg_claims_total(const struct rg_claim_outcomes *outcomes, struct rg_sheet *sheet);
// Adds the notes about machines, if there are several: what each is, and the verdicts that differ.
void rg_claims_compare(const struct rg_claim_outcomes *outcomes, struct rg_sheet *sheet);

#endif
