// All commands.
#ifndef RG_HARNESS_COMMANDS_COMMANDS_H
#define RG_HARNESS_COMMANDS_COMMANDS_H

#include "harness/cli/command.h"

// NULL-terminated, made by the build from the list in harness/commands/meson.build.
extern const struct rg_command *const rg_commands[];

// What the program does, one line.
extern const char rg_program_about[];

// The command of this name, or NULL.
const struct rg_command *rg_command_find(const char *name);

#endif
