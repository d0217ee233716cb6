// What --set gives to all cells of a table.
#ifndef RG_HARNESS_COMMANDS_TABLES_SETS_H
#define RG_HARNESS_COMMANDS_TABLES_SETS_H

#include "harness/cli/option.h"

// The words as one text with spaces between them, which the caller frees; NULL without any. False,
// and one logged line, where one has a space of its own, all are more than a record holds, or
// without memory.
bool rg_sets_join(const struct rg_words *words, char **text);

#endif
