// All commands.
#ifndef RG_HARNESS_COMMANDS_COMMANDS_H
#define RG_HARNESS_COMMANDS_COMMANDS_H

#include "harness/commands/cli/command.h"

// NULL-terminated; the build generates it from the list in harness/commands/meson.build.
extern const struct rg_command *const rg_commands[];

// The program's description, in one line.
extern const char rg_program_about[];

// The command of this name, or NULL.
const struct rg_command *rg_command_find(const char *name);

#endif
