#include <string.h>

#include "harness/report/report.h"
#include "harness/tables/claims/json.h"

static bool is(const json_t *object, const char *field, const char *value)
{
    const char *text = json_string_value(json_object_get(object, field));
    return text && !strcmp(text, value);
}

// The state of a claim. Figures of one launch are no verdict, so they count only if there is no
// verdict.
static enum rg_page_stand stand_of(const json_t *claim)
{
    bool holds = false, fails = false, fits = false, misses = false;
    size_t i;
    json_t *verdict;
    json_array_foreach(json_object_get(claim, "verdicts"), i, verdict)
    {
        const bool is_one = is(verdict, "verdict", "one launch");
        holds = holds || is(verdict, "verdict", rg_claim_verdict_text(RG_CLAIM_REPRODUCED));
        fails = fails || is(verdict, "verdict", rg_claim_verdict_text(RG_CLAIM_NOT_REPRODUCED));
        fits = fits || (is_one && is(verdict, "figures", "fits"));
        misses = misses || (is_one && is(verdict, "figures", "misses"));
    }
    if (holds || fails)
        return holds && fails ? RG_STAND_MIXED : holds ? RG_STAND_HOLDS : RG_STAND_FAILS;
    return misses ? RG_STAND_MISSES : fits ? RG_STAND_FITS : RG_STAND_OPEN;
}

int rg_page_stands(const json_t *claims, int counts[RG_STANDS])
{
    size_t i;
    json_t *claim;
    memset(counts, 0, RG_STANDS * sizeof(*counts));
    json_array_foreach(claims, i, claim)
    {
        counts[stand_of(claim)]++;
    }
    return (int)json_array_size(claims);
}

json_t *rg_page_claims(const struct rg_page *page)
{
    json_t *own = page->outcomes.count ? rg_claims_json(&page->outcomes) : NULL, *found = NULL;
    size_t i;
    json_t *record;
    if (own)
        found = json_incref(json_object_get(own, "claims"));
    json_decref(own);
    json_array_foreach(page->records, i, record)
    {
        json_t *claims = json_object_get(json_object_get(record, "document"), "claims");
        if (!found && json_is_array(claims))
            found = json_incref(claims);
    }
    return found;
}
