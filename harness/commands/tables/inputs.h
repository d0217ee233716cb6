// Protects the user's own files that a table's cells read from being replaced by its results.
#ifndef RG_HARNESS_COMMANDS_TABLES_INPUTS_H
#define RG_HARNESS_COMMANDS_TABLES_INPUTS_H

#include "harness/tables/table.h"

// Whether no result or journal of these tables in `folder` (NULL: none) replaces a file that a
// row's settings name. Settings have `set`, "key=value key=value" (NULL: nothing), applied. False,
// and one logged line, if one would.
bool rg_inputs_are_spared(const struct rg_table *const tables[], int count, const char *set,
                          const char *folder);

#endif
