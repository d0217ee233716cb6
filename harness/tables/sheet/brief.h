// A result for who wants to know how it stands: one line a row, each device beside print.
#ifndef RG_HARNESS_TABLES_SHEET_BRIEF_H
#define RG_HARNESS_TABLES_SHEET_BRIEF_H

#include <stdio.h>

#include "harness/record/result.h"

// Prints it as Markdown: a table for each work and variant, with the rows' curves; then what the
// paper claims of it, and notes of five lines at most. Painted where the output is a terminal that
// shows colours. False, and one logged line, without memory.
bool rg_brief_print(const struct rg_result *result, FILE *out);

#endif
