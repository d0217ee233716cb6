// Options shared by several commands. Each table is included at a value of the type given here, and
// means the same in all commands; the default is the including command's.
#ifndef RG_HARNESS_COMMANDS_CLI_SHARED_H
#define RG_HARNESS_COMMANDS_CLI_SHARED_H

#include "core/base/text/words.h"
#include "harness/commands/cli/option.h"
#include "harness/devices/devices.h"

extern const struct rg_option rg_devices_option[];  // char *: --device, comma-separated, or "all"
extern const struct rg_option rg_asked_options[];   // struct rg_devices_asked: --require, --timeout
extern const struct rg_option rg_timeout_option[];  // int, seconds: --timeout
extern const struct rg_option rg_settings_option[]; // struct rg_words: --set
extern const struct rg_option rg_size_option[];     // struct rg_size: --size
extern const struct rg_option rg_memory_option[];   // int64_t, bytes: --memory
extern const struct rg_option rg_frame_option[];    // int: --frame
extern const struct rg_option rg_exposure_option[]; // double: --exposure
extern const struct rg_option rg_json_option[];     // bool: --json
extern const struct rg_option rg_length_options[];  // struct rg_length: --quick, --full

// The size of pictures in most commands.
#define RG_DEFAULT_SIZE "512x512"

struct rg_length {
    bool quick, full; // at most one is set
};

// Whether a command that takes hours for all tables was asked for them: by names of tables, a
// length, or a budget (NULL: none). False, and one logged line, if not.
bool rg_length_is_asked(const char *command, const struct rg_words *tables,
                        const struct rg_length *length, const char *budget);

#endif
