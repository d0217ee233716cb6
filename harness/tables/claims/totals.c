// The lead of the page of claims: one sentence, and three totals by device.
#include <stdio.h>
#include <string.h>

#include "harness/tables/claims/text.h"

// The outcomes with a verdict, on a device (NULL: on all).
static int count_on(const struct rg_claim_outcomes *o, enum rg_claim_verdict verdict,
                    const char *device)
{
    int count = 0;
    for (int i = 0; i < o->count; i++)
        count += o->outcomes[i].judgement.verdict == verdict &&
                 (!device || !strcmp(o->outcomes[i].device, device));
    return count;
}

static int count_verdicts(const struct rg_claim_outcomes *o, enum rg_claim_verdict verdict)
{
    return count_on(o, verdict, NULL);
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
static void add_total(const struct rg_claim_outcomes *o, const char *name,
                      enum rg_claim_verdict verdict, struct rg_sheet *sheet)
{
    char devices[512] = "";
    size_t used = 0;
    for (int i = 0; i < o->count && used < sizeof(devices); i++) {
        const char *device = o->outcomes[i].device;
        const int count = is_first_of_device(o, i) ? count_on(o, verdict, device) : 0;
        if (count)
            used += (size_t)snprintf(devices + used, sizeof(devices) - used, "%s%s %d",
                                     used ? ", " : "", device, count);
    }
    rg_sheet_note(sheet, "%s: %d%s%s%s.", name, count_verdicts(o, verdict), *devices ? " (" : "",
                  devices, *devices ? ")" : "");
    sheet->lead_count++;
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

static void add_sentence(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    const int devices = count_devices(o);
    rg_sheet_note(sheet,
                  "%d claims on %d device%s: %d hold, %d do not, %d are open, %d at the bound; %d "
                  "are not judged.",
                  count_claims(o), devices, devices == 1 ? "" : "s",
                  count_verdicts(o, RG_CLAIM_REPRODUCED),
                  count_verdicts(o, RG_CLAIM_NOT_REPRODUCED), count_verdicts(o, RG_CLAIM_UNDECIDED),
                  count_verdicts(o, RG_CLAIM_AT_BOUND),
                  count_verdicts(o, RG_CLAIM_OTHER_WORK) + count_verdicts(o, RG_CLAIM_NOT_SEEN));
    sheet->lead_count++;
}

static int count_figures(const struct rg_claim_outcomes *o, enum rg_claim_figures figures)
{
    int count = 0;
    for (int i = 0; i < o->count; i++)
        count += o->outcomes[i].judgement.verdict == RG_CLAIM_ONE_LAUNCH &&
                 o->outcomes[i].judgement.figures == figures;
    return count;
}

void rg_claims_total(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    add_sentence(o, sheet);
    add_total(o, "Holds", RG_CLAIM_REPRODUCED, sheet);
    add_total(o, "Does not hold", RG_CLAIM_NOT_REPRODUCED, sheet);
    add_total(o, "Open", RG_CLAIM_UNDECIDED, sheet);
    if (!count_verdicts(o, RG_CLAIM_ONE_LAUNCH))
        return;
    rg_sheet_note(sheet,
                  "One launch, no verdict: %d fit the claim, %d do not, %d lie near the bound; "
                  "`raingauge claims` decides.",
                  count_figures(o, RG_FIGURES_FIT), count_figures(o, RG_FIGURES_MISS),
                  count_figures(o, RG_FIGURES_NEAR));
    sheet->lead_count++;
}
