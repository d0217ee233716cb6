// Verdicts on the claims of all papers, as JSON.
#ifndef RG_HARNESS_TABLES_CLAIMS_JSON_H
#define RG_HARNESS_TABLES_CLAIMS_JSON_H

#include "harness/tables/claims/outcomes.h"

// "claims" in docs/records.schema.json; the caller owns it. NULL when memory runs out.
json_t *rg_claims_json(const struct rg_claim_outcomes *outcomes);
// The machines of records, "machines" there; the caller owns the array.
json_t *rg_claims_machines_json(const struct rg_origins *origins);
// The numbers by which claims are judged, as {looks, fall, reversal}; the caller owns the object.
json_t *rg_claims_rules_json(void);

#endif
