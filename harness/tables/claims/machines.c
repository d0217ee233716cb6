// Verdicts on several machines side by side.
#include <string.h>

#include "core/base/text/add.h"
#include "harness/tables/claims/text.h"

static bool has_origin(const struct rg_claim_outcomes *o, int origin)
{
    bool has = false;
    for (int i = 0; i < o->count; i++)
        has = has || o->outcomes[i].origin == origin;
    return has;
}

// "A: AMD EPYC, 2 cores. B: AMD EPYC, 4 cores; not as A: cores 4 and not 2."
static void add_machines(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    int first = -1;
    for (int i = 0; i < o->origins.count; i++) {
        const struct rg_origin *origin = &o->origins.all[i];
        char name[RG_ORIGIN_NAME], base[RG_ORIGIN_NAME], differs[RG_KEY_TEXT] = "";
        if (!has_origin(o, i))
            continue;
        rg_origin_name(i, name);
        rg_origin_name(first, base);
        if (first >= 0)
            rg_origin_difference(origin, &o->origins.all[first], differs);
        else
            first = i;
        rg_sheet_note(sheet, "%s: %s, key %s%s%s%s%s.", name, origin->text, origin->key,
                      *differs ? "; not as " : "", *differs ? base : "", *differs ? ": " : "",
                      differs);
    }
}

static bool is_same_place(const struct rg_claim_outcome *a, const struct rg_claim_outcome *b)
{
    return a->claim == b->claim && !strcmp(a->device, b->device);
}

// A verdict that is not seen is compared with no other.
static bool is_seen(const struct rg_claim_outcome *outcome)
{
    const struct rg_judgement *j = &outcome->judgement;
    return j->verdict != RG_CLAIM_NOT_SEEN &&
           (j->verdict != RG_CLAIM_ONE_LAUNCH || j->figures != RG_FIGURES_NONE);
}

// The verdicts on a claim and a device by machine: "no on A, yes on B", and whether they differ.
// Returns how many are seen, from the first one on; 0 for all others.
static int list_verdicts(const struct rg_claim_outcomes *o, int from, char *text, size_t size,
                         bool *differ)
{
    const struct rg_claim_outcome *first = &o->outcomes[from];
    int count = 0;
    *text = 0;
    *differ = false;
    for (int i = 0; i < o->count && is_seen(first); i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        char name[RG_ORIGIN_NAME];
        if (!is_same_place(outcome, first) || !is_seen(outcome))
            continue;
        if (i < from)
            return 0;
        const char *mark = rg_claim_mark(&outcome->judgement, false);
        rg_origin_name(outcome->origin, name);
        rg_text_add(text, size, ", ", "%s on %s", mark, name);
        *differ = *differ || strcmp(mark, rg_claim_mark(&first->judgement, false)) != 0;
        count++;
    }
    return count;
}

static void add_differing(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    int both = 0, differing = 0;
    char verdicts[1024], title[RG_CLAIM_TITLE];
    bool differ;
    for (int i = 0; i < o->count; i++) {
        both += list_verdicts(o, i, verdicts, sizeof(verdicts), &differ) > 1;
        differing += differ;
    }
    rg_sheet_note(sheet, "%d verdict%s compared between machines: %d differ%s.", both,
                  both == 1 ? "" : "s", differing, differing == 1 ? "s" : "");
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        if (list_verdicts(o, i, verdicts, sizeof(verdicts), &differ) < 2 || !differ)
            continue;
        rg_claim_title(outcome->claim, title);
        rg_sheet_note(sheet, "Differs: %s, %s on %s: %s.", outcome->claim->table, title,
                      outcome->device, verdicts);
    }
}

void rg_claims_compare(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    if (!rg_claims_are_of_several(o))
        return;
    add_machines(o, sheet);
    add_differing(o, sheet);
}
