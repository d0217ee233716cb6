// A result as a table of text, for people.
#ifndef RG_HARNESS_TABLES_SHEET_SHEET_H
#define RG_HARNESS_TABLES_SHEET_SHEET_H

#include "harness/console/sheet.h"
#include "harness/record/result.h"

// Makes the sheet, which must be zeroed before; the caller frees it.
void rg_result_sheet(const struct rg_result *result, struct rg_sheet *sheet);

// Adds the notes. `shown`: names of facts with a column, NULL-terminated.
void rg_result_notes(const struct rg_result *result, const char *const *shown,
                     struct rg_sheet *sheet);

// Says how many cells are marked, and why; "" if none is.
void rg_result_marks(const struct rg_result *result, char *text, size_t size);

// Whether a printed value of a record is the frame rate that is compared.
bool rg_is_frame_rate(const struct rg_named *published);

#endif
