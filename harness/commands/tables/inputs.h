// Files of the user's own that cells of a table read, against those that its results replace.
#ifndef RG_HARNESS_COMMANDS_TABLES_INPUTS_H
#define RG_HARNESS_COMMANDS_TABLES_INPUTS_H

#include "harness/tables/table.h"

// Whether neither results nor journals of these tables in a folder (NULL: none) replace a file that
// the settings of a row name, with `set`, "key=value key=value" (NULL: nothing), over them. False,
// and one logged line.
bool rg_inputs_are_spared(const struct rg_table *const tables[], int count, const char *set,
                          const char *folder);

#endif
