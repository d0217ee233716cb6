#include "harness/commands/tables/verdicts.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/output.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/claims/json.h"
#include "harness/tables/claims/text.h"
#include "harness/tables/print.h"

// Whether two results of one table can be judged together.
static bool can_be_of(struct rg_claim_outcomes *outcomes, const struct rg_result *result,
                      const struct rg_result *before, const char *path)
{
    char here[RG_CLAIMS_LENGTH], there[RG_CLAIMS_LENGTH];
    rg_claims_length(result, here, sizeof(here));
    rg_claims_length(before, there, sizeof(there));
    if (strcmp(here, there) != 0)
        return rg_error("%s: holds table '%s' measured %s, and %s, which no verdict mixes; name "
                        "the file of one of them",
                        path, result->table, there, here);
    return rg_origins_known(&outcomes->origins, result->passport) !=
               rg_origins_known(&outcomes->origins, before->passport) ||
           rg_error("%s: holds table '%s' twice, as results do that lie beside a journal; name the "
                    "file of one of them",
                    path, result->table);
}

bool rg_verdicts_can_be_of(struct rg_claim_outcomes *outcomes, const struct rg_stored *stored,
                           const struct rg_words *ids, const char *path)
{
    bool ok = true;
    for (int i = 0; ok && i < stored->count; i++) {
        const struct rg_result *result = &stored->results[i];
        if (!rg_words_name(ids, result->table))
            continue;
        ok = rg_origins_find(&outcomes->origins, result->passport) >= 0;
        for (int k = 0; ok && k < i; k++)
            if (!strcmp(stored->results[k].table, result->table))
                ok = can_be_of(outcomes, result, &stored->results[k], path);
    }
    return ok;
}

// False when memory runs out.
static bool print_sheet(const struct rg_claim_outcomes *outcomes, int form)
{
    struct rg_sheet sheet = {0};
    rg_claims_sheet(outcomes, form != RG_RESULT_MD, &sheet);
    if (form == RG_RESULT_CSV)
        rg_sheet_print_csv(&sheet, stdout);
    else if (form == RG_RESULT_TEX)
        rg_sheet_print_tex(&sheet, stdout);
    else
        rg_sheet_print_md(&sheet, stdout);
    rg_sheet_free(&sheet);
    return !sheet.incomplete;
}

// False, and one logged line, when memory runs out.
static bool print_json(const struct rg_claim_outcomes *outcomes)
{
    json_t *json = rg_claims_json(outcomes);
    if (!json)
        return rg_harness_error("claims: no memory to print them; close other programs");
    json_dumpf(json, stdout, JSON_INDENT(1) | RG_JSON_FLAGS);
    printf("\n");
    json_decref(json);
    return true;
}

int rg_verdicts_print(const struct rg_claim_outcomes *outcomes, int form)
{
    if (!outcomes->count)
        return RG_EXIT_PASS;
    const bool is_whole =
        form == RG_RESULT_JSON ? print_json(outcomes) : print_sheet(outcomes, form);
    if (!fflush(stdout) && !ferror(stdout))
        return is_whole ? RG_EXIT_PASS : rg_exit_of_error();
    rg_stdout_error();
    return rg_exit_of_error();
}
