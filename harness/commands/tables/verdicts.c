#include "harness/commands/tables/verdicts.h"

#include <stdio.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/output.h"
#include "harness/record/schema/schema.h"
#include "harness/tables/claims/json.h"
#include "harness/tables/print.h"

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
