// The lead of the page of claims: one sentence, and three totals by device.
#include <stdio.h>
#include <string.h>

#include "harness/tables/claims/text.h"

// Outcomes that a line counts: those with this verdict, or of one launch with these figures.
struct total {
    const char *name;
    enum rg_claim_verdict verdict;
    enum rg_claim_figures figures;
};

static bool counts(const struct total *total, const struct rg_claim_outcome *outcome)
{
    return outcome->judgement.verdict == total->verdict &&
           (total->verdict != RG_CLAIM_ONE_LAUNCH || outcome->judgement.figures == total->figures);
}

static int count_on(const struct rg_claim_outcomes *o, const struct total *total,
                    const char *device)
{
    int count = 0;
    for (int i = 0; i < o->count; i++)
        count +=
            counts(total, &o->outcomes[i]) && (!device || !strcmp(o->outcomes[i].device, device));
    return count;
}

// Whether no outcome before this one has its device.
static bool is_first_of_device(const struct rg_claim_outcomes *o, int i)
{
    for (int k = 0; k < i; k++)
        if (!strcmp(o->outcomes[k].device, o->outcomes[i].device))
            return false;
    return true;
}

// "Holds: 40 (cpu 20, gl 20)."
static void add_total(const struct rg_claim_outcomes *o, const struct total *total,
                      struct rg_sheet *sheet)
{
    char devices[512] = "";
    size_t used = 0;
    for (int i = 0; i < o->count && used < sizeof(devices); i++) {
        const char *device = o->outcomes[i].device;
        const int count = is_first_of_device(o, i) ? count_on(o, total, device) : 0;
        if (count)
            used += (size_t)snprintf(devices + used, sizeof(devices) - used, "%s%s %d",
                                     used ? ", " : "", device, count);
    }
    rg_sheet_note(sheet, "%s: %d%s%s%s.", total->name, count_on(o, total, NULL),
                  *devices ? " (" : "", devices, *devices ? ")" : "");
    sheet->lead_count++;
}

static int count_verdicts(const struct rg_claim_outcomes *o, enum rg_claim_verdict verdict)
{
    int count = 0;
    for (int i = 0; i < o->count; i++)
        count += o->outcomes[i].judgement.verdict == verdict;
    return count;
}

static int count_devices(const struct rg_claim_outcomes *o)
{
    int count = 0;
    for (int i = 0; i < o->count; i++)
        count += is_first_of_device(o, i);
    return count;
}

static int count_claims(const struct rg_claim_outcomes *o)
{
    int count = 0;
    for (int i = 0; i < o->count; i++)
        count += !i || o->outcomes[i].claim != o->outcomes[i - 1].claim;
    return count;
}

static void add_sentence(const struct rg_claim_outcomes *o, int once, struct rg_sheet *sheet)
{
    const int devices = count_devices(o);
    rg_sheet_note(
        sheet,
        "%d claims on %d device%s: %d hold, %d do not, %d are open, %d are at the bound; %d "
        "are not judged, as other work or not seen%s.",
        count_claims(o), devices, devices == 1 ? "" : "s", count_verdicts(o, RG_CLAIM_REPRODUCED),
        count_verdicts(o, RG_CLAIM_NOT_REPRODUCED), count_verdicts(o, RG_CLAIM_UNDECIDED),
        count_verdicts(o, RG_CLAIM_AT_BOUND),
        count_verdicts(o, RG_CLAIM_OTHER_WORK) + count_verdicts(o, RG_CLAIM_NOT_SEEN),
        once ? ", and others have figures of one launch, which decide nothing "
               "(`raingauge claims` takes launches)"
             : "");
    sheet->lead_count++;
}

void rg_claims_total(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    static const struct total by_launches[] = {
        {"Holds", RG_CLAIM_REPRODUCED, RG_FIGURES_NONE},
        {"Does not hold", RG_CLAIM_NOT_REPRODUCED, RG_FIGURES_NONE},
        {"Open", RG_CLAIM_UNDECIDED, RG_FIGURES_NONE}};
    static const struct total of_one[] = {
        {"One launch, which fits the claim", RG_CLAIM_ONE_LAUNCH, RG_FIGURES_FIT},
        {"One launch, which does not", RG_CLAIM_ONE_LAUNCH, RG_FIGURES_MISS},
        {"One launch, near the bound", RG_CLAIM_ONE_LAUNCH, RG_FIGURES_NEAR}};
    const int once = count_verdicts(o, RG_CLAIM_ONE_LAUNCH);
    add_sentence(o, once, sheet);
    for (size_t i = 0; i < sizeof(by_launches) / sizeof(by_launches[0]); i++)
        add_total(o, &by_launches[i], sheet);
    for (size_t i = 0; once && i < sizeof(of_one) / sizeof(of_one[0]); i++)
        add_total(o, &of_one[i], sheet);
}
