// Tables of a user's own, from text files (docs/tables.md#a-table-from-a-file).
#ifndef RG_HARNESS_TABLES_OWN_FILE_H
#define RG_HARNESS_TABLES_OWN_FILE_H

#include "harness/tables/papers/published.h"

// Whether a table's name is that of a file: it has a slash, or ends in ".table".
bool rg_own_is_file(const char *name);
// Reads a file. Its table and its claims are known to rg_table_find and rg_claims from then on,
// until the process ends. NULL, and one logged line with file, line and mend, if it is refused.
const struct rg_table *rg_own_read(const char *path);

#endif
