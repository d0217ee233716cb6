// A brief result: one line for each row, with each device next to print.
#ifndef RG_HARNESS_TABLES_SHEET_BRIEF_H
#define RG_HARNESS_TABLES_SHEET_BRIEF_H

#include <stdio.h>

#include "harness/record/result.h"

// Prints it as Markdown: a table for each work and variant, with curves of the rows; then the
// paper's claims, and up to five lines of notes. Terminals with colours show colours. False, and
// one logged line, when memory runs out.
bool rg_brief_print(const struct rg_result *result, FILE *out);
// Prints it for an article, as print has it: a LaTeX table for each work and variant, of what tells
// rows apart, print, and frames a second on each device. Needs booktabs. The same on failure.
bool rg_brief_print_tex(const struct rg_result *result, FILE *out);

#endif
