#include "harness/tables/claims/outcomes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"

// The marks of verdicts on the page; its notes explain them. Figures of one launch are no verdict
// and stand in brackets.
static const char *const marks[RG_CLAIM_VERDICTS] = {"yes",   "no",     "bound", "open",
                                                     "other", "unseen", ""};
static const char *const figure_marks[RG_FIGURES_COUNT] = {"(yes)", "(no)", "(near)", "unseen"};
const char *rg_claim_verdict_mark(enum rg_claim_verdict verdict)
{
    return marks[verdict];
}

const char *rg_claim_mark(const struct rg_judgement *j, bool wide)
{
    if (wide)
        return rg_judgement_text(j);
    return j->verdict == RG_CLAIM_ONE_LAUNCH ? figure_marks[j->figures] : marks[j->verdict];
}

const char *rg_claim_agreement_text(enum rg_claim_agreement agreement)
{
    static const char *const texts[] = {"", "agrees", "differs", "not seen"};
    return texts[agreement];
}

void rg_claims_length(const struct rg_result *result, char *text, size_t size)
{
    const char *length = result->full ? "full" : "quick";
    const char *set = result->full ? "" : result->quick;
    int used = snprintf(text, size, "%s%s%s%s", length, *set ? " (" : "", set, *set ? ")" : "");
    if (result->size_divisor > 1 && used < (int)size)
        snprintf(text + used, size - (size_t)used, ", with 1/%d of the width and height",
                 result->size_divisor);
}

// Adds the result's own JSON description (docs/records.md), and its devices.
static bool add_table(struct rg_claim_outcomes *o, const struct rg_result *result, int origin)
{
    char machine[RG_ORIGIN_NAME];
    if (!o->tables && !(o->tables = json_array()))
        return rg_harness_error("claims: no memory");
    rg_origin_name(origin, machine);
    json_t *table = json_pack("{ss ss ss so si sO?}", "table", result->table, "machine", machine,
                              "length", result->full ? "full" : "quick", "quick",
                              *result->quick ? rg_json_text(result->quick) : json_null(),
                              "size_divisor", result->size_divisor > 1 ? result->size_divisor : 1,
                              "passport", result->passport);
    if (*result->changed)
        json_object_set_new(table, "changed", rg_json_text(result->changed));
    return !json_array_append_new(o->tables, table) || rg_harness_error("claims: no memory");
}

// --- verdicts that are kept ---

// Figures near the bound agree with every verdict.
static enum rg_claim_agreement agreement_of(enum rg_claim_verdict kept, enum rg_claim_figures today)
{
    const enum rg_claim_figures due = kept == RG_CLAIM_REPRODUCED       ? RG_FIGURES_FIT
                                      : kept == RG_CLAIM_NOT_REPRODUCED ? RG_FIGURES_MISS
                                                                        : RG_FIGURES_NEAR;
    if (!rg_claim_is_decided(kept))
        return RG_AGREEMENT_NONE;
    if (today == RG_FIGURES_NONE)
        return RG_AGREEMENT_NOT_SEEN;
    return today == due || today == RG_FIGURES_NEAR ? RG_AGREEMENT_AGREES : RG_AGREEMENT_DIFFERS;
}

// The processor's name, from the passport of the launches.
static void take_machine(const struct rg_result *result, char machine[RG_TITLE_SIZE])
{
    const json_t *cpu = json_object_get(json_object_get(result->passport, "machine"), "cpu");
    const char *name = json_string_value(cpu);
    rg_text_copy(machine, RG_TITLE_SIZE, name ? name : "");
}

// Takes the verdict of a kept record on the same device, if it has one by launches.
static void take_record(struct rg_claim_outcome *outcome, const struct rg_result *result)
{
    for (int d = 0; d < result->device_count; d++) {
        if (strcmp(result->devices[d].name, outcome->device) != 0)
            continue;
        const struct rg_judgement j = rg_claim_judge(outcome->claim, result, d);
        if (j.verdict == RG_CLAIM_ONE_LAUNCH || j.verdict == RG_CLAIM_NOT_SEEN)
            continue;
        outcome->agreement = agreement_of(j.verdict, outcome->judgement.figures);
        outcome->judgement = j;
        outcome->is_kept = true;
        take_machine(result, outcome->machine);
        rg_claims_length(result, outcome->length, sizeof(outcome->length));
    }
}

// Takes the kept verdict of the outcome's own machine, or else of one that is not shown.
static void take_kept(const struct rg_claim_outcomes *o, struct rg_claim_outcome *outcome,
                      const struct rg_stored *kept)
{
    for (int own = 0; own < 2; own++)
        for (int i = 0; kept && i < kept->count; i++)
            if (!strcmp(kept->results[i].table, outcome->claim->table) &&
                rg_origins_known(&o->origins, kept->results[i].passport) ==
                    (own ? outcome->origin : -1))
                take_record(outcome, &kept->results[i]);
}

static bool is_shown(const struct rg_claim *claim, const struct rg_claims_shown *shown)
{
    const int low = claim->first < claim->last ? claim->first : claim->last;
    const int high = claim->first < claim->last ? claim->last : claim->first;
    const bool is_variant = !shown->variant || !strcmp(claim->variant, shown->variant) ||
                            (claim->other && !strcmp(claim->other, shown->variant));
    return is_variant &&
           (!shown->first_row || (low <= shown->last_row && high >= shown->first_row));
}

// Makes room for an outcome behind those of its claim. NULL, with one logged line, without memory.
static struct rg_claim_outcome *insert(struct rg_claim_outcomes *o, const struct rg_claim *claim)
{
    int at = o->count;
    if (!rg_array_fit(&o->outcomes, &o->room, o->count + 1, sizeof(*o->outcomes), "claims"))
        return NULL;
    for (int i = 0; i < o->count; i++)
        at = o->outcomes[i].claim == claim ? i + 1 : at;
    memmove(&o->outcomes[at + 1], &o->outcomes[at], (size_t)(o->count - at) * sizeof(*o->outcomes));
    o->count++;
    return &o->outcomes[at];
}

static bool add_outcome(struct rg_claim_outcomes *o, const struct rg_claim *claim, int origin,
                        const struct rg_result *result, int device, const struct rg_stored *kept)
{
    struct rg_claim_outcome *outcome = insert(o, claim);
    if (!outcome)
        return false;
    *outcome = (struct rg_claim_outcome){
        .claim = claim, .origin = origin, .judgement = rg_claim_judge(claim, result, device)};
    memcpy(outcome->device, result->devices[device].name, RG_NAME_SIZE);
    rg_claims_length(result, outcome->length, sizeof(outcome->length));
    take_machine(result, outcome->machine);
    if (!outcome->judgement.launches)
        take_kept(o, outcome, kept);
    return true;
}

bool rg_claims_add(struct rg_claim_outcomes *o, const struct rg_result *result,
                   const struct rg_stored *kept, const struct rg_claims_shown *shown)
{
    const int before = o->count, origin = rg_origins_find(&o->origins, result->passport);
    if (origin < 0)
        return false;
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
        for (int i = 0; i < result->device_count && !strcmp(claim->table, result->table); i++)
            if (is_shown(claim, shown) && !add_outcome(o, claim, origin, result, i, kept))
                return false;
    return o->count == before || add_table(o, result, origin);
}

void rg_claims_free(struct rg_claim_outcomes *outcomes)
{
    free(outcomes->outcomes);
    json_decref(outcomes->tables);
    rg_origins_free(&outcomes->origins);
    *outcomes = (struct rg_claim_outcomes){0};
}

// --- several machines ---

bool rg_claims_are_of_several(const struct rg_claim_outcomes *o)
{
    bool several = false;
    for (int i = 1; i < o->count; i++)
        several = several || o->outcomes[i].origin != o->outcomes[0].origin;
    return several;
}

void rg_claim_place(const struct rg_claim_outcomes *o, const struct rg_claim_outcome *outcome,
                    char place[RG_CLAIM_PLACE])
{
    char name[RG_ORIGIN_NAME];
    rg_origin_name(outcome->origin, name);
    snprintf(place, RG_CLAIM_PLACE, "%s%s%s", outcome->device,
             rg_claims_are_of_several(o) ? " of " : "", rg_claims_are_of_several(o) ? name : "");
}
