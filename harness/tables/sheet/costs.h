// What rows that switch something off cost, of a table of no paper whose first row has all on.
#ifndef RG_HARNESS_TABLES_SHEET_COSTS_H
#define RG_HARNESS_TABLES_SHEET_COSTS_H

#include "harness/console/sheet.h"
#include "harness/record/result.h"

// Notes what a frame of each other row takes of the first's time, and how far its picture is from
// the truth, for the work, variant and device that a place names. Nothing of tables without a truth
// or without names of rows, where something is published, or where a cell has no number.
void rg_note_costs(const struct rg_result *result, struct rg_sheet *sheet, struct rg_place of);

#endif
