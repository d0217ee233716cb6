// The options and arguments of a command as rows: name, meaning, value and default.
//
// A command has a struct for the values, and a table of rows, each with its value's offset in that
// struct. Parsing, --help, the manual page and bash's completion all use these rows. Options of
// several commands are tables that others include (shared.h).
#ifndef RG_HARNESS_COMMANDS_CLI_OPTION_H
#define RG_HARNESS_COMMANDS_CLI_OPTION_H

#include <stdbool.h>
#include <stddef.h>

enum {
    RG_MAX_WORDS = 64,
    RG_MAX_OPTION_ROWS = 64,
    RG_ARGUMENT_SIZE = 64, // of the placeholder of a value
    RG_ABOUT_SIZE = 512,
};

// The kind of a row, and the type of its value.
enum rg_option_kind {
    RG_OPTION_END,     // after the last row
    RG_OPTION_GROUP,   // a heading, `about`, for the following rows
    RG_OPTION_INCLUDE, // includes the rows of `included`; their offsets are relative to this row's
    RG_OPTION_OPERAND, // an argument of the command, without an offset; `run` gets all of them
    RG_OPTION_FLAG,    // bool: whether it was given
    RG_OPTION_INT,     // int, from `least` to `most`; least - 1: not given, and no default
    RG_OPTION_FACTOR,  // double, above 0 and at most `most`; 0: not given, and no default
    RG_OPTION_CHOICE,  // int, index into `choices`; -1: not given, and no default
    RG_OPTION_SIZE,    // struct rg_size
    RG_OPTION_BYTES,   // int64_t, above 0; 0: not given
    RG_OPTION_RANGE,   // struct rg_range, from `least` to `most`; least - 1: not given
    RG_OPTION_TEXT,    // char *, owned by the parser; NULL: not given, and no default
    RG_OPTION_TEXTS,   // struct rg_words: one for each occurrence
    RG_OPTION_HELP,    // --help, which every command has
};

// The kind of names that a text holds, for completion.
enum rg_names {
    RG_NAMES_NOTHING,
    RG_NAMES_TECHNIQUE,
    RG_NAMES_TABLE,
    RG_NAMES_FIGURE,
    RG_NAMES_DEVICE,
    RG_NAMES_DEVICES,   // separated by commas, or "all"
    RG_NAMES_PARAMETER, // KEY=VALUE of the techniques among the arguments
    RG_NAMES_FILE,
    RG_NAMES_FOLDER,
};

struct rg_option {
    enum rg_option_kind kind;
    const char *name;     // "output", without its dashes; NULL: not an option
    const char *argument; // placeholder of its value: "WxH"; NULL for a choice: all choices
    const char *about;    // one line: what it means
    size_t offset;        // of its value
    char letter;          // 'o', after one dash; 0: none
    const char *initial;  // the default in the user's notation; NULL: none. An include's overrides
                          // that of its rows.
    double least, most;   // inclusive, of numbers and ranges
    const char *const *choices; // the allowed values of options and operands; NULL-terminated
    enum rg_names names;
    int first, last;      // for operands: its positions, from 1; last 0: all from the first on
    const char *excludes; // names of options that exclude it, separated by spaces
    int arguments;        // for a group: the number of arguments that its options require; 0: any
    const struct rg_option *included;
};

#define RG_GROUP(title)                                                                            \
    {                                                                                              \
        RG_OPTION_GROUP, .about = (title)                                                          \
    }
// A heading of options that require this many arguments, and are refused with another number.
#define RG_GROUP_OF(count, title)                                                                  \
    {                                                                                              \
        RG_OPTION_GROUP, .about = (title), .arguments = (count)                                    \
    }
// Includes a shared table; `default_value` is the default of its rows, NULL: none.
#define RG_INCLUDE(table, at, default_value)                                                       \
    {                                                                                              \
        RG_OPTION_INCLUDE, .included = (table), .offset = (at), .initial = (default_value)         \
    }

// Words of the command line: arguments, or values of a repeatable option.
struct rg_words {
    int count;
    const char *items[RG_MAX_WORDS];
};
// Whether a text is among the words, or there are none.
bool rg_words_name(const struct rg_words *words, const char *text);

struct rg_size {
    int width, height; // pixels; 0: not given
};

struct rg_range {
    int first, last; // inclusive
};

// Expands a table's includes and adds --help; offsets are relative to the command's struct, and
// each row has its group's number of arguments. `rows` has room for RG_MAX_OPTION_ROWS. Returns
// their number.
int rg_option_rows(const struct rg_option *table, struct rg_option *rows);

// The placeholder of a row's value, "md|csv|json|tex" for a choice; "" if it takes none.
const char *rg_option_argument(const struct rg_option *row, char text[RG_ARGUMENT_SIZE]);

// A row's meaning, with its default.
const char *rg_option_about(const struct rg_option *row, char text[RG_ABOUT_SIZE]);

// Sets a row's value, in a zeroed struct, to that of an option that was not given and has no
// default.
void rg_option_clear(const struct rg_option *row, void *values);
// Parses `text`, as the user or a default writes it. False when it is refused, and one logged line,
// which refers to the command's help if useful.
bool rg_option_set(const struct rg_option *row, void *values, const char *text,
                   const char *command);
// Frees what the value owns.
void rg_option_free(const struct rg_option *row, void *values);

#endif
