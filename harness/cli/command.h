// How a command is declared, and run with what the command line says.
#ifndef RG_HARNESS_CLI_COMMAND_H
#define RG_HARNESS_CLI_COMMAND_H

#include "harness/cli/option.h"
#include "harness/console/exit.h"

struct rg_command {
    const char *name;
    const char *usage;               // after "raingauge NAME"
    const char *about;               // one line
    const struct rg_option *options; // its table
    size_t options_size;             // of its struct of values
    // `options` is that struct, `arguments` what is no option: no more of them than the table's
    // operands have places for. Returns an enum rg_exit.
    int (*run)(const void *options, const struct rg_words *arguments);
    // The exit status where the table refuses something; NULL: RG_EXIT_USAGE.
    int (*refused)(void);
};

// Runs a command with its options and arguments; argv[0] is the command's name. Or prints its help
// where that is asked for. Returns an enum rg_exit: bad usage, with one logged line, where the
// table refuses something.
int rg_command_run(const struct rg_command *command, int argc, const char **argv);

// Prints a command's usage, what it does, and its options by group.
void rg_command_print_help(const struct rg_command *command);

#endif
