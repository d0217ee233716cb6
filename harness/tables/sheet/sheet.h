// A result as a table of text, for people.
#ifndef RG_HARNESS_TABLES_SHEET_SHEET_H
#define RG_HARNESS_TABLES_SHEET_SHEET_H

#include "harness/console/sheet.h"
#include "harness/record/result.h"

// Makes the sheet, which is zeroed before, and which the caller frees.
void rg_result_sheet(const struct rg_result *result, struct rg_sheet *sheet);

// Adds the notes below it. `shown`: names of facts that have a column, NULL-terminated.
void rg_result_notes(const struct rg_result *result, const char *const *shown,
                     struct rg_sheet *sheet);

// What a reader calls the printed number that is compared, among those of a record.
bool rg_is_frame_rate(const struct rg_named *published);

#endif
