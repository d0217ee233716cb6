// The tables that a command names.
#ifndef RG_HARNESS_COMMANDS_TABLES_CHOSEN_H
#define RG_HARNESS_COMMANDS_TABLES_CHOSEN_H

#include "harness/commands/cli/option.h"
#include "harness/tables/papers/published.h"

// Logs that a table is unknown, with the nearest. False.
bool rg_table_refuse(const char *id);

// The names of tables, with each file read (harness/tables/own) and replaced by its table's name.
// False, and one logged line, where one is refused.
bool rg_tables_read(const struct rg_words *names, struct rg_words *ids);

// The tables that are named, each once, or all. False, with one logged line, where one is unknown.
bool rg_tables_choose(const struct rg_words *ids, const struct rg_table *chosen[RG_MAX_WORDS],
                      int *count);

#endif
