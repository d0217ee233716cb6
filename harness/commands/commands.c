#include "harness/commands/commands.h"

#include <string.h>

#include "harness/commands/lists.h"

#define DECLARE(name) extern const struct rg_command rg_command_##name;
#define ENTRY(name)   &rg_command_##name,

RG_COMMANDS(DECLARE)
const struct rg_command *const rg_commands[] = {RG_COMMANDS(ENTRY) NULL};

const char rg_program_about[] =
    "runs the rain of published papers on every graphics API, compares, and measures";

const struct rg_command *rg_command_find(const char *name)
{
    for (int i = 0; rg_commands[i]; i++)
        if (!strcmp(rg_commands[i]->name, name))
            return rg_commands[i];
    return NULL;
}
