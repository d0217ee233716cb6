// The verdicts on claims from the results of one machine or several.
#ifndef RG_HARNESS_TABLES_CLAIMS_OUTCOMES_H
#define RG_HARNESS_TABLES_CLAIMS_OUTCOMES_H

#include "harness/record/disk/stored.h"
#include "harness/record/passport/origins.h"
#include "harness/tables/claims/claim.h"

enum { RG_CLAIMS_LENGTH = RG_TITLE_SIZE + 64 };

// Whether today's figures agree with the kept verdict.
enum rg_claim_agreement {
    RG_AGREEMENT_NONE, // no verdict is kept
    RG_AGREEMENT_AGREES,
    RG_AGREEMENT_DIFFERS,
    RG_AGREEMENT_NOT_SEEN, // today's figures do not show it
};
const char *rg_claim_agreement_text(enum rg_claim_agreement agreement);

// A claim's verdict on one device of a machine.
struct rg_claim_outcome {
    const struct rg_claim *claim;
    int origin; // index
    char device[RG_NAME_SIZE];
    // The length of the judged measurement: "full", or "quick (atlas=small), with 1/4 of the width
    // and height".
    char length[RG_CLAIMS_LENGTH];
    struct rg_judgement judgement;     // by launches, if there are any
    bool is_kept;                      // the launches are those of the kept records
    enum rg_claim_agreement agreement; // with figures measured now
    char machine[RG_TITLE_SIZE];       // on which the launches were taken
};

struct rg_claim_outcomes {
    int count;
    int64_t room;                      // capacity, for rg_array_fit
    struct rg_claim_outcome *outcomes; // owned; a claim's are contiguous, and so are its machine's
    struct rg_origins origins;         // the machines; rows name them if there are several
    json_t *tables;                    // owned; the JSON description of each judged table
};

// "full", or "quick" with its settings, either with the ratio of the pictures' size to the table's.
void rg_claims_length(const struct rg_result *result, char *text, size_t size);

// The part of the claims that is shown: those about a variant (NULL: all) and some of the rows,
// from 1 (0: all).
struct rg_claims_shown {
    const char *variant;
    int first_row, last_row;
};

// Adds the outcomes of a table's claims, of those that are shown. If the result has no launches,
// takes the verdicts of `kept` (NULL: none), and compares the result's figures with them: those of
// its own machine, or else of one that is no other of the outcomes' machines. Zero the outcomes
// before the first call. False, with one logged line, when memory runs out.
bool rg_claims_add(struct rg_claim_outcomes *outcomes, const struct rg_result *result,
                   const struct rg_stored *kept, const struct rg_claims_shown *shown);
void rg_claims_free(struct rg_claim_outcomes *outcomes);

// The mark of a verdict on the page.
const char *rg_claim_verdict_mark(enum rg_claim_verdict verdict);
// The same of a judgement, of which figures of one launch stand in brackets; or its words.
const char *rg_claim_mark(const struct rg_judgement *judgement, bool wide);

// Whether the outcomes are of several machines.
bool rg_claims_are_of_several(const struct rg_claim_outcomes *outcomes);
// "gl", or "gl of B" if the outcomes are of several machines.
enum { RG_CLAIM_PLACE = RG_NAME_SIZE + RG_ORIGIN_NAME + 8 };
void rg_claim_place(const struct rg_claim_outcomes *outcomes, const struct rg_claim_outcome *of,
                    char place[RG_CLAIM_PLACE]);

#endif
