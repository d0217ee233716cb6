// Results in the forms that people and programs read.
#ifndef RG_HARNESS_TABLES_PRINT_H
#define RG_HARNESS_TABLES_PRINT_H

#include <stdio.h>

#include "harness/record/result.h"
#include "harness/tables/table.h"

// "md", "csv", "json", "tex", NULL, and the places of some among them.
extern const char *const rg_result_formats[];
enum { RG_RESULT_MD, RG_RESULT_CSV, RG_RESULT_JSON, RG_RESULT_TEX };
// Markdown with all columns and notes, which the other forms have anyway.
enum { RG_RESULT_WIDE = -1 };

// Prints a result in a format, by its place among them, or wide. False, and one logged line,
// without memory.
bool rg_result_print(const struct rg_result *result, int format, FILE *out);

// Writes it into a folder (NULL: none) where it is whole, and prints what there is of it to stdout.
// Returns the exit status that its cells come to; an error against the truth that could not be
// found counts as a failure. RG_EXIT_USAGE, and one logged line, where a file or stdout could not
// be written.
int rg_result_finish(const struct rg_result *result, int format, const char *folder);
// What its cells come to alone.
int rg_result_exit(const struct rg_result *result);

// Whether the files of so many tables can be written into a folder, as is found out before any
// work. False, and one logged line.
bool rg_results_can_be_written(const struct rg_table *const tables[], int count,
                               const char *folder);
// Whether none of a table's files in a folder, its journals among them, replaces one that is read.
// False, and one logged line.
bool rg_result_spares(const struct rg_table *table, const char *folder, const char *read);
// Writes it into a folder in every format, as TABLE.FORMAT; where it has no number, what is there
// is kept, and one line says so. False, and one logged line, on failure.
bool rg_result_write(const struct rg_result *result, const char *folder);

#endif
