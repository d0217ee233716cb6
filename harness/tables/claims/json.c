#include "harness/tables/claims/json.h"

#include "harness/judge/settle.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/papers/papers.h"

static const char *const sources[] = {[RG_CLAIM_SAID] = "said", [RG_CLAIM_PRINTED] = "printed"};

static json_t *bound(bool has, double value)
{
    return has ? rg_number_json(value) : json_null();
}

static json_t *knee_json(const struct rg_claim *claim)
{
    const int until = claim->until ? claim->until : claim->knee;
    return claim->knee ? json_pack("[ii]", claim->knee, until) : json_null();
}

// A claim and its test, without a verdict.
static json_t *claim_json(const struct rg_claim *claim)
{
    const struct rg_claim_form *test = &rg_claim_forms[claim->test];
    const struct rg_table *table = rg_table_find(claim->table);
    char id[RG_CLAIM_ID];
    rg_claim_id(claim, id);
    return json_pack("{ss ss ss ss ss ss ss? ss ss ss? s[ii] so so so sb}", "id", id, "table",
                     claim->table, "paper", table ? rg_table_paper(table) : "", "section",
                     claim->where, "source", sources[claim->source], "words", claim->words, "part",
                     claim->part, "test", test->name, "variant", claim->variant, "other_variant",
                     claim->other, "rows", claim->first, claim->last, "knee_rows", knee_json(claim),
                     "least", bound(test->needs & RG_CLAIM_LEAST, claim->least), "most",
                     bound(test->needs & RG_CLAIM_MOST, claim->most), "is_ours", claim->is_ours);
}

static json_t *text_or_null(const char *text)
{
    return *text ? json_string(text) : json_null();
}

static json_t *machine_json(const struct rg_origins *origins, int number)
{
    const struct rg_origin *origin = &origins->all[number];
    char name[RG_ORIGIN_NAME], differs[RG_KEY_TEXT] = "";
    rg_origin_name(number, name);
    if (number)
        rg_origin_difference(origin, &origins->all[0], differs);
    return json_pack("{ss ss so so}", "name", name, "key", origin->key, "text",
                     rg_json_text(origin->text), "differs",
                     *differs ? rg_json_text(differs) : json_null());
}

json_t *rg_claims_machines_json(const struct rg_origins *origins)
{
    json_t *machines = json_array();
    for (int i = 0; i < origins->count; i++)
        json_array_append_new(machines, machine_json(origins, i));
    return machines;
}

json_t *rg_claims_rules_json(void)
{
    json_t *looks = json_array();
    for (int i = 0; i < rg_settle_rule.look_count; i++)
        json_array_append_new(looks, json_integer(rg_settle_rule.looks[i]));
    return json_pack("{so sf sf}", "looks", looks, "fall", RG_CLAIM_FALL, "reversal",
                     RG_CLAIM_REVERSAL);
}

static json_t *verdict_json(const struct rg_claim_outcome *outcome)
{
    static const char *const figures[RG_FIGURES_COUNT] = {"fits", "misses", "near", ""};
    const struct rg_judgement *j = &outcome->judgement;
    const int left = j->needed > j->launches ? j->needed - j->launches : 0;
    char machine[RG_ORIGIN_NAME];
    rg_origin_name(outcome->origin, machine);
    return json_pack("{so ss ss so sn si si so si si si so sb so}", "device",
                     rg_json_text(outcome->device), "machine", machine, "verdict",
                     rg_claim_verdict_text(j->verdict), "why", rg_json_text(j->why), "probability",
                     "rows_judged", j->rows, "rows_needed", j->rows_needed, "figures",
                     text_or_null(figures[j->figures]), "launches", j->launches,
                     "launches_disturbed", j->disturbed, "launches_needed", left, "hours_needed",
                     rg_number_json(left * j->launch_s / 3600), "kept", outcome->is_kept, "today",
                     text_or_null(rg_claim_agreement_text(outcome->agreement)));
}

json_t *rg_claims_json(const struct rg_claim_outcomes *o)
{
    json_t *claims = json_array(), *verdicts = NULL;
    for (int i = 0; i < o->count; i++) {
        const struct rg_claim_outcome *outcome = &o->outcomes[i];
        if (!i || outcome->claim != o->outcomes[i - 1].claim) {
            json_t *claim = claim_json(outcome->claim);
            verdicts = json_array();
            json_object_set_new(claim, "print_contradicts",
                                json_boolean(outcome->judgement.print_contradicts));
            json_object_set_new(claim, "verdicts", verdicts);
            json_array_append_new(claims, claim);
        }
        json_array_append_new(verdicts, verdict_json(outcome));
    }
    return json_pack("{siso sO so}", "format", RG_FORMAT_VERSION, "machines",
                     rg_claims_machines_json(&o->origins), "tables", o->tables, "claims", claims);
}
