#include <string.h>

#include "harness/report/page.h"
#include "harness/tables/claims/json.h"

bool rg_page_is(const json_t *object, const char *field, const char *value)
{
    const char *text = json_string_value(json_object_get(object, field));
    return text && !strcmp(text, value);
}

// Whether a verdict is one on a machine; NULL: on any.
static bool is_on(const json_t *verdict, const char *machine)
{
    return !machine || rg_page_is(verdict, "machine", machine);
}

// The state of a claim on a machine. Figures of one launch are no verdict, so they count only if
// there is no verdict. RG_STANDS if it has none there.
static enum rg_page_stand stand_of(const json_t *claim, const char *machine)
{
    bool any = false, holds = false, fails = false, fits = false, misses = false;
    size_t i;
    json_t *verdict;
    json_array_foreach(json_object_get(claim, "verdicts"), i, verdict)
    {
        const bool is_one = rg_page_is(verdict, "verdict", "one launch");
        if (!is_on(verdict, machine))
            continue;
        any = true;
        holds = holds || rg_page_is(verdict, "verdict", rg_claim_verdict_text(RG_CLAIM_REPRODUCED));
        fails =
            fails || rg_page_is(verdict, "verdict", rg_claim_verdict_text(RG_CLAIM_NOT_REPRODUCED));
        fits = fits || (is_one && rg_page_is(verdict, "figures", "fits"));
        misses = misses || (is_one && rg_page_is(verdict, "figures", "misses"));
    }
    if (!any && machine)
        return RG_STANDS;
    if (holds || fails)
        return holds && fails ? RG_STAND_MIXED : holds ? RG_STAND_HOLDS : RG_STAND_FAILS;
    return misses ? RG_STAND_MISSES : fits ? RG_STAND_FITS : RG_STAND_OPEN;
}

int rg_page_stands(const json_t *claims, const char *machine, int counts[RG_STANDS])
{
    size_t i;
    json_t *claim;
    int all = 0;
    memset(counts, 0, RG_STANDS * sizeof(*counts));
    json_array_foreach(claims, i, claim)
    {
        const enum rg_page_stand stand = stand_of(claim, machine);
        if (stand == RG_STANDS)
            continue;
        counts[stand]++;
        all++;
    }
    return all;
}

// Whether two verdicts are the same; figures count where there is nothing else.
static bool are_alike(const json_t *a, const json_t *b)
{
    return json_equal(json_object_get(a, "verdict"), json_object_get(b, "verdict")) &&
           (!rg_page_is(a, "verdict", "one launch") ||
            json_equal(json_object_get(a, "figures"), json_object_get(b, "figures")));
}

static bool is_seen(const json_t *verdict)
{
    return !rg_page_is(verdict, "verdict", rg_claim_verdict_text(RG_CLAIM_NOT_SEEN)) &&
           (!rg_page_is(verdict, "verdict", "one launch") ||
            json_is_string(json_object_get(verdict, "figures")));
}

bool rg_page_differs(const json_t *claim, const char *device)
{
    const json_t *first = NULL;
    size_t i;
    json_t *verdict;
    json_array_foreach(json_object_get(claim, "verdicts"), i, verdict)
    {
        if (!rg_page_is(verdict, "device", device) || !is_seen(verdict))
            continue;
        first = first ? first : verdict;
        if (!are_alike(first, verdict))
            return true;
    }
    return false;
}

json_t *rg_page_claims(const struct rg_page *page)
{
    json_t *found = page->outcomes.count ? rg_claims_json(&page->outcomes) : NULL;
    size_t i;
    json_t *record;
    json_array_foreach(page->records, i, record)
    {
        json_t *document = json_object_get(record, "document");
        if (!found && json_is_array(json_object_get(document, "claims")))
            found = json_incref(document);
    }
    return found;
}
