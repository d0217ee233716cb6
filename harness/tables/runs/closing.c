#include "harness/tables/runs/closing.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"

void rg_closing_add(struct rg_closing *closing, const struct rg_result *result)
{
    for (struct rg_place at = rg_result_start(result); rg_result_next(result, &at);) {
        const enum rg_outcome outcome = rg_result_at(result, at)->outcome;
        closing->cells++;
        closing->unsupported += outcome == RG_UNSUPPORTED;
        closing->failed += outcome != RG_OK && outcome != RG_UNSUPPORTED;
    }
}

int rg_closing_measured(const struct rg_closing *closing)
{
    return closing->cells - closing->failed - closing->unsupported;
}

void rg_closing_tell(const struct rg_closing *closing, int devices)
{
    const int lost = closing->failed + closing->unsupported;
    char of[24] = "", without[64] = "";
    if (lost)
        snprintf(of, sizeof(of), "%d of ", rg_closing_measured(closing));
    if (closing->failed)
        snprintf(without, sizeof(without), "; %d failed", closing->failed);
    if (closing->unsupported)
        snprintf(without + strlen(without), sizeof(without) - strlen(without), "%s %d unsupported",
                 closing->failed ? "," : ";", closing->unsupported);
    rg_info("%s%d cell%s measured on %d device%s%s", of, closing->cells,
            closing->cells == 1 ? "" : "s", devices, devices == 1 ? "" : "s", without);
}
