// The text below a brief table: the paper's claims, and notes.
#ifndef RG_HARNESS_TABLES_SHEET_BELOW_H
#define RG_HARNESS_TABLES_SHEET_BELOW_H

#include <stdio.h>

#include "harness/record/result.h"

// Prints the claims, and up to five lines of notes.
void rg_brief_below(const struct rg_result *result, FILE *out);

#endif
