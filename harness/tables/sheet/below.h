// What stands below a brief table: what the paper claims, and notes.
#ifndef RG_HARNESS_TABLES_SHEET_BELOW_H
#define RG_HARNESS_TABLES_SHEET_BELOW_H

#include <stdio.h>

#include "harness/record/result.h"

// Prints the claims, and notes of five lines at most.
void rg_brief_below(const struct rg_result *result, FILE *out);

#endif
