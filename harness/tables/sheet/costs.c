#include "harness/tables/sheet/costs.h"

#include <math.h>
#include <stdio.h>

// Whether all rows of a work, variant and device are present and have numbers.
static bool can_be_told(const struct rg_result *result, struct rg_place at)
{
    if (!*result->truth || result->last_row == result->first_row)
        return false;
    for (at.row = result->first_row; at.row <= result->last_row; at.row++) {
        const struct rg_record *record =
            rg_result_has(result, at.row) ? rg_result_at(result, at) : NULL;
        if (!record || record->outcome != RG_OK || record->truth_error.outcome != RG_OK ||
            !*record->row[0].text || !isnan(rg_record_published_fps(record)) ||
            !(rg_record_fps(record) > 0))
            return false;
    }
    return true;
}

void rg_note_costs(const struct rg_result *result, struct rg_sheet *sheet, struct rg_place of)
{
    if (!can_be_told(result, of))
        return;
    of.row = result->first_row;
    const struct rg_record *first = rg_result_at(result, of);
    char costs[512] = "";
    size_t used = 0;
    for (of.row++; of.row <= result->last_row && used < sizeof(costs); of.row++) {
        const struct rg_record *record = rg_result_at(result, of);
        used += (size_t)snprintf(costs + used, sizeof(costs) - used, "%s%s %.2f (FLIP %.3f)",
                                 used ? ", " : "", record->row[0].text,
                                 rg_record_fps(first) / rg_record_fps(record),
                                 record->truth_error.flip_mask_mean);
    }
    rg_sheet_note(sheet, "Cost on %s: of the time of a frame of `%s`, one of these takes: %s.",
                  result->devices[of.device].name, first->row[0].text, costs);
}
