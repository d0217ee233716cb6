// Results in the forms that people and programs read.
#ifndef RG_HARNESS_TABLES_PRINT_H
#define RG_HARNESS_TABLES_PRINT_H

#include <stdio.h>

#include "harness/record/result.h"

// "md", "csv", "json", "tex", NULL, and the places of some among them.
extern const char *const rg_result_formats[];
enum { RG_RESULT_CSV = 1, RG_RESULT_JSON = 2, RG_RESULT_TEX = 3 };

// Prints a result in a format, by its place among them. False, and one logged line, without memory.
bool rg_result_print(const struct rg_result *result, int format, FILE *out);

// Writes it into a folder in every format, as TABLE.FORMAT. False, and one logged line, on failure.
bool rg_result_write(const struct rg_result *result, const char *folder);

#endif
