// Protects the user's own files that a table's cells read from being replaced by its results.
#ifndef RG_HARNESS_COMMANDS_TABLES_INPUTS_H
#define RG_HARNESS_COMMANDS_TABLES_INPUTS_H

#include "harness/tables/table.h"

// Whether neither results nor journals of these tables in `folder` (NULL: none) replace a file
// named by a row's settings with `set`, "key=value key=value" (NULL: nothing), applied. False, and
// one logged line, if one would.
bool rg_inputs_are_spared(const struct rg_table *const tables[], int count, const char *set,
                          const char *folder);

#endif
