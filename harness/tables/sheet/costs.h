// The cost of features, in a table of no paper whose first row has all switched on and whose other
// rows each switch one off.
#ifndef RG_HARNESS_TABLES_SHEET_COSTS_H
#define RG_HARNESS_TABLES_SHEET_COSTS_H

#include "harness/console/sheet.h"
#include "harness/record/result.h"

// Adds a note for the work, variant and device of a place: each other row's time relative to the
// first row's, and its error against the truth. Nothing for tables without a truth or row names,
// with published numbers, or with a cell without a number.
void rg_note_costs(const struct rg_result *result, struct rg_sheet *sheet, struct rg_place of);

#endif
