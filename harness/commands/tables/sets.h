// The assignments of --set for all cells of a table.
#ifndef RG_HARNESS_COMMANDS_TABLES_SETS_H
#define RG_HARNESS_COMMANDS_TABLES_SETS_H

#include "harness/commands/cli/option.h"

// Joins words with spaces, which the caller frees; NULL if there are none. False, and one logged
// line, if one contains a space, the text exceeds a record, or memory runs out.
bool rg_sets_join(const struct rg_words *words, char **text);

#endif
