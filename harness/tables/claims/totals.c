// The lead of the page of claims: one sentence, and three totals by device and machine.
#include <stdio.h>
#include <string.h>

#include "core/base/text/add.h"
#include "harness/tables/claims/text.h"

enum { EVERY = -1 };

// Which outcomes to count.
struct counted {
    int verdict, figures; // EVERY: whichever
    const char *device;   // NULL: of all
    int origin;           // EVERY: of all
};

static int count_all(const struct rg_claim_outcomes *o, struct counted of)
{
    int count = 0;
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        count += (of.verdict == EVERY || (int)outcome->judgement.verdict == of.verdict) &&
                 (of.figures == EVERY || (int)outcome->judgement.figures == of.figures) &&
                 (!of.device || !strcmp(outcome->device, of.device)) &&
                 (of.origin == EVERY || outcome->origin == of.origin);
    }
    return count;
}

static int count_verdicts(const struct rg_claim_outcomes *o, enum rg_claim_verdict verdict)
{
    return count_all(o, (struct counted){(int)verdict, EVERY, NULL, EVERY});
}

// Whether no outcome before this one has its device.
static bool is_first_of_device(const struct rg_claim_outcomes *o, int i)
{
    for (int k = 0; k < i; k++)
        if (!strcmp(o->outcomes[k].device, o->outcomes[i].device))
            return false;
    return true;
}

// Adds a device's counts by machine: "cpu 5 of 8 on A, 6 of 8 on B".
static void add_machines(const struct rg_claim_outcomes *o, struct counted of, char *text,
                         size_t size)
{
    const char *between = "; ";
    const struct counted all = {EVERY, EVERY, of.device, EVERY};
    for (int i = 0; i < o->origins.count; i++) {
        struct counted here = of, all_here = all;
        char name[RG_ORIGIN_NAME];
        here.origin = all_here.origin = i;
        if (!count_all(o, all_here))
            continue;
        rg_origin_name(i, name);
        rg_text_add(text, size, between, "%s%s%d of %d on %s", *between == ';' ? of.device : "",
                    *between == ';' ? " " : "", count_all(o, here), count_all(o, all_here), name);
        between = ", ";
    }
}

// Writes counts by device, or by device and machine if there are several: " (cpu 20, gl 20)". ""
// if all are 0.
static void write_places(const struct rg_claim_outcomes *o, struct counted of, char *text,
                         size_t size)
{
    const bool of_several = rg_claims_are_of_several(o);
    char places[2048] = "";
    for (int i = 0; i < o->count; i++) {
        of.device = o->outcomes[i].device;
        const int count = is_first_of_device(o, i) ? count_all(o, of) : 0;
        if (count && of_several)
            add_machines(o, of, places, sizeof(places));
        else if (count)
            rg_text_add(places, sizeof(places), ", ", "%s %d", of.device, count);
    }
    snprintf(text, size, "%s%s%s", *places ? " (" : "", places, *places ? ")" : "");
}

// "Holds: 40 (cpu 20, gl 20)."
static void add_total(const struct rg_claim_outcomes *o, const char *name,
                      enum rg_claim_verdict verdict, struct rg_sheet *sheet)
{
    char places[2052];
    write_places(o, (struct counted){(int)verdict, EVERY, NULL, EVERY}, places, sizeof(places));
    rg_sheet_note(sheet, "%s: %d%s.", name, count_verdicts(o, verdict), places);
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

static int count_machines(const struct rg_claim_outcomes *o)
{
    int count = 0;
    for (int i = 0; i < o->origins.count; i++)
        count += count_all(o, (struct counted){EVERY, EVERY, NULL, i}) > 0;
    return count;
}

static void add_sentence(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    const int claims = count_claims(o), devices = count_devices(o), machines = count_machines(o);
    char of_machines[40] = "";
    if (machines > 1)
        snprintf(of_machines, sizeof(of_machines), " of %d machines", machines);
    rg_sheet_note(sheet,
                  "%d claim%s on %d device%s%s: %d hold, %d do not, %d are open, %d at the bound; "
                  "%d are not judged.",
                  claims, claims == 1 ? "" : "s", devices, devices == 1 ? "" : "s", of_machines,
                  count_verdicts(o, RG_CLAIM_REPRODUCED),
                  count_verdicts(o, RG_CLAIM_NOT_REPRODUCED), count_verdicts(o, RG_CLAIM_UNDECIDED),
                  count_verdicts(o, RG_CLAIM_AT_BOUND),
                  count_verdicts(o, RG_CLAIM_OTHER_WORK) + count_verdicts(o, RG_CLAIM_NOT_SEEN));
    sheet->lead_count++;
}

static struct counted of_figures(enum rg_claim_figures figures)
{
    return (struct counted){RG_CLAIM_ONE_LAUNCH, (int)figures, NULL, EVERY};
}

void rg_claims_total(const struct rg_claim_outcomes *o, struct rg_sheet *sheet)
{
    char places[2052] = "";
    add_sentence(o, sheet);
    add_total(o, "Holds", RG_CLAIM_REPRODUCED, sheet);
    add_total(o, "Does not hold", RG_CLAIM_NOT_REPRODUCED, sheet);
    add_total(o, "Open", RG_CLAIM_UNDECIDED, sheet);
    if (!count_verdicts(o, RG_CLAIM_ONE_LAUNCH))
        return;
    if (rg_claims_are_of_several(o))
        write_places(o, of_figures(RG_FIGURES_FIT), places, sizeof(places));
    rg_sheet_note(sheet,
                  "One launch, no verdict: %d fit the claim%s, %d do not, %d lie near the bound; "
                  "`raingauge claims` decides.",
                  count_all(o, of_figures(RG_FIGURES_FIT)), places,
                  count_all(o, of_figures(RG_FIGURES_MISS)),
                  count_all(o, of_figures(RG_FIGURES_NEAR)));
    sheet->lead_count++;
}
