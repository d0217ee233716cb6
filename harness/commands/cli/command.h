// Declares commands, and runs them with the command line.
#ifndef RG_HARNESS_COMMANDS_CLI_COMMAND_H
#define RG_HARNESS_COMMANDS_CLI_COMMAND_H

#include "harness/commands/cli/option.h"
#include "harness/console/exit.h"

// Whom a command is for first; `raingauge --help` groups them so.
enum rg_reader { RG_FOR_DRIVERS, RG_FOR_PAPERS, RG_FOR_ALL, RG_READERS };

struct rg_command {
    const char *name;
    enum rg_reader reader;
    const char *usage;               // after "raingauge NAME"
    const char *about;               // one line
    const struct rg_option *options; // table of options
    size_t options_size;             // size of the struct of values
    // Runs the command. `options` is that struct, `arguments` the remaining words, at most as many
    // as the table has operands. Returns an enum rg_exit.
    int (*run)(const void *options, const struct rg_words *arguments);
    // The exit status for a refused command line; NULL: rg_exit_of_error.
    int (*refused)(void);
};

// Parses a command's options and arguments and runs it, or prints its help; argv[0] is the
// command's name. Returns an enum rg_exit. If the table refuses something, or memory for it is
// lacking, the status is that of the logged line.
int rg_command_run(const struct rg_command *command, int argc, const char **argv);

// Prints a command's usage, its description, and its options by group.
void rg_command_print_help(const struct rg_command *command);

#endif
