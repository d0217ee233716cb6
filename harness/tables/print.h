// Prints and writes results in all formats.
#ifndef RG_HARNESS_TABLES_PRINT_H
#define RG_HARNESS_TABLES_PRINT_H

#include <stdio.h>

#include "harness/record/result.h"
#include "harness/tables/table.h"

// "md", "csv", "json", "tex", NULL; and the indices of some of them.
extern const char *const rg_result_formats[];
enum { RG_RESULT_MD, RG_RESULT_CSV, RG_RESULT_JSON, RG_RESULT_TEX };
// Markdown with all columns and notes, as the other formats have them anyway.
enum { RG_RESULT_WIDE = -1 };

// Prints a result in the format of this index, or wide. False, and one logged line, without memory.
bool rg_result_print(const struct rg_result *result, int format, FILE *out);

// Writes a complete result into a folder (NULL: none), and prints the result to stdout. Returns the
// exit status of its cells; a missing error against the truth counts as a failure.
// RG_EXIT_USAGE, and one logged line, if a file or stdout could not be written.
int rg_result_finish(const struct rg_result *result, int format, const char *folder);
// The exit status of its cells alone.
int rg_result_exit(const struct rg_result *result);

// Checks before any work that the files of these tables can be written into a folder. False, and
// one logged line, if not.
bool rg_results_can_be_written(const struct rg_table *const tables[], int count,
                               const char *folder);
// Whether no file of a table in a folder, its journals included, would replace the file `read`.
// False, and one logged line, if one would.
bool rg_result_spares(const struct rg_table *table, const char *folder, const char *read);
// Writes a result into a folder in every format, as TABLE.FORMAT. If it has no number, existing
// files stay, and one line says so. False, and one logged line, on failure.
bool rg_result_write(const struct rg_result *result, const char *folder);

#endif
