#include "harness/commands/commands.h"

#include <string.h>

#include "harness/commands/lists.h"

#define DECLARE(name) extern const struct rg_command rg_command_##name;
#define ENTRY(name)   &rg_command_##name,

RG_COMMANDS(DECLARE)
const struct rg_command *const rg_commands[] = {RG_COMMANDS(ENTRY) NULL};

const char rg_program_about[] =
    "finds out whether a graphics driver draws correctly, and how fast, by the rain of five papers";

const struct rg_command *rg_command_find(const char *name)
{
    for (int i = 0; rg_commands[i]; i++)
        if (!strcmp(rg_commands[i]->name, name))
            return rg_commands[i];
    return NULL;
}
