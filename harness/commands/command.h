// What every command shares: exit statuses, options, and how a command is declared.
#ifndef RG_HARNESS_COMMANDS_COMMAND_H
#define RG_HARNESS_COMMANDS_COMMAND_H

#include <stdbool.h>

#include "core/device/device.h"
#include "core/techniques/technique.h"

enum rg_exit {
    RG_EXIT_PASS = 0,
    RG_EXIT_FAIL = 1,  // differs, regressed, not verified
    RG_EXIT_USAGE = 2, // bad usage or input
    RG_EXIT_INCONCLUSIVE = 3,
    RG_EXIT_NOTHING = 4,      // nothing was measured
    RG_EXIT_UNSUPPORTED = 77, // not supported on this machine
    RG_EXIT_SIGNALLED = 128,  // and the signal's number: ended early because it was asked to
};

// The options, each with one meaning everywhere; a command accepts some of them.
enum rg_option_bits {
    RG_OPT_DEVICE = 1 << 0,      // --device D,...|all
    RG_OPT_SET = 1 << 1,         // --set KEY=VALUE, repeatable
    RG_OPT_SIZE = 1 << 2,        // --size WxH
    RG_OPT_FRAME = 1 << 3,       // --frame N
    RG_OPT_OUTPUT = 1 << 4,      // -o, --output PATH
    RG_OPT_JSON = 1 << 5,        // --json
    RG_OPT_LENGTH = 1 << 6,      // --quick, --full
    RG_OPT_FORMAT = 1 << 7,      // --format md|csv|json|tex
    RG_OPT_ROWS = 1 << 8,        // --rows A-B
    RG_OPT_EXPOSURE = 1 << 9,    // --exposure X
    RG_OPT_BACKGROUND = 1 << 10, // --background FILE
    RG_OPT_FRESH = 1 << 11,      // --fresh
    RG_OPT_FROM = 1 << 12,       // --from DIR
};

enum { RG_MAX_SETS = 64, RG_MAX_ARGS = 64 };

struct rg_options {
    char *device; // NULL: not given
    char *sets[RG_MAX_SETS];
    int set_count;
    int width, height; // 0: not given
    int frame;         // -1: not given
    char *output, *format, *background, *from;
    bool json, quick, full, fresh;
    int first_row, last_row;       // from 1; 0: not given
    double exposure;               // 0: not given
    const char *args[RG_MAX_ARGS]; // what is no option
    int arg_count;
    void *context; // of the option parser; freed by rg_options_free
};

struct rg_command {
    const char *name;
    const char *usage;                            // after "raingauge NAME"
    const char *about;                            // one line
    unsigned options;                             // enum rg_option_bits
    int (*run)(const struct rg_options *options); // returns an enum rg_exit
};

// All commands, NULL-terminated, made by the build from the list in harness/meson.build.
extern const struct rg_command *const rg_commands[];

// Parses a command's options. RG_EXIT_PASS: run it. -1: help was printed, exit 0. Else the exit
// status, and one line was logged.
int rg_options_parse(const struct rg_command *command, int argc, const char **argv,
                     struct rg_options *options);
void rg_options_free(struct rg_options *options);

// Refuses with one logged line what is given beyond so many arguments of a command.
bool rg_options_at_most(const struct rg_options *options, const char *command, int arguments);

// The technique that `options` name first and its settings with every --set applied; the caller
// frees the settings. NULL, and one logged line, when there is none or a value is refused.
const struct rg_technique *rg_options_technique(const struct rg_options *options, void **settings);

// A technique's settings with every --set applied; the caller frees them. NULL, and one logged
// line, when a value is refused.
void *rg_options_settings(const struct rg_options *options, const struct rg_technique *technique);

#endif
