// The options and arguments of a command, as rows: what each is called, means, takes and defaults
// to.
//
// A command has a struct of its own for the values, and one table of rows, each of which says where
// in that struct its value lies. Parsing, --help, the manual page and bash's completion all go by
// these rows. What several commands take is a table that theirs include (shared.h).
#ifndef RG_HARNESS_CLI_OPTION_H
#define RG_HARNESS_CLI_OPTION_H

#include <stdbool.h>
#include <stddef.h>

enum {
    RG_MAX_WORDS = 64,
    RG_MAX_OPTION_ROWS = 64,
    RG_ARGUMENT_SIZE = 64, // of text that stands for a value
    RG_ABOUT_SIZE = 512,
};

// What a row is, and the type of the value at its offset.
enum rg_option_kind {
    RG_OPTION_END,     // behind the last row
    RG_OPTION_GROUP,   // a heading, `about`, for the rows that follow
    RG_OPTION_INCLUDE, // the rows of `included`; their offsets count from this row's
    RG_OPTION_OPERAND, // an argument of the command; it has no offset, `run` is given all of them
    RG_OPTION_FLAG,    // bool: whether it was given
    RG_OPTION_INT,     // int, from `least` to `most`; least - 1: not given, without a default
    RG_OPTION_FACTOR,  // double, above 0 and at most `most`; 0: not given, without a default
    RG_OPTION_CHOICE,  // int, the index among `choices`; -1: not given, without a default
    RG_OPTION_SIZE,    // struct rg_size
    RG_OPTION_BYTES,   // int64_t, above 0; 0: not given
    RG_OPTION_RANGE,   // struct rg_range, from `least` to `most`; least - 1: not given
    RG_OPTION_TEXT,    // char *, which the parser owns; NULL: not given, without a default
    RG_OPTION_TEXTS,   // struct rg_words: one for each time that it was given
    RG_OPTION_HELP,    // --help, which every command has
};

// What a text names, for completion.
enum rg_names {
    RG_NAMES_NOTHING,
    RG_NAMES_TECHNIQUE,
    RG_NAMES_TABLE,
    RG_NAMES_FIGURE,
    RG_NAMES_DEVICE,
    RG_NAMES_DEVICES,   // with commas between them, or "all"
    RG_NAMES_PARAMETER, // KEY=VALUE of the techniques that the arguments name
    RG_NAMES_FILE,
    RG_NAMES_FOLDER,
};

struct rg_option {
    enum rg_option_kind kind;
    const char *name;     // "output", which follows two dashes; NULL: the row is no option
    const char *argument; // what stands for its value: "WxH"; of a choice, NULL: all choices
    const char *about;    // one line: what it means
    size_t offset;        // of its value
    char letter;          // 'o', which follows one dash; 0: none
    const char *initial;  // the default, as the user would write it; NULL: none. An include's goes
                          // before those of its rows.
    double least, most;   // inclusive, of numbers and ranges
    const char *const *choices; // the only values, of options and operands; NULL-terminated
    enum rg_names names;
    int first, last;      // of operands: where it may stand among them, from 1; last 0: anywhere
                          // from the first on
    const char *excludes; // names of options that cannot be given with it, with spaces between them
    int arguments;        // of a group: its options go with so many arguments alone; 0: any number
    const struct rg_option *included;
};

#define RG_GROUP(title)                                                                            \
    {                                                                                              \
        RG_OPTION_GROUP, .about = (title)                                                          \
    }
// A heading of options that a command uses where it has so many arguments, and refuses where it has
// another number of them.
#define RG_GROUP_OF(count, title)                                                                  \
    {                                                                                              \
        RG_OPTION_GROUP, .about = (title), .arguments = (count)                                    \
    }
// Takes the rows of a shared table; `default_value` is what they are without being given, NULL for
// nothing.
#define RG_INCLUDE(table, at, default_value)                                                       \
    {                                                                                              \
        RG_OPTION_INCLUDE, .included = (table), .offset = (at), .initial = (default_value)         \
    }

// Words of the command line: arguments, or what a repeatable option was given.
struct rg_words {
    int count;
    const char *items[RG_MAX_WORDS];
};

struct rg_size {
    int width, height; // pixels; 0: not given
};

struct rg_range {
    int first, last; // inclusive
};

// The rows of a table with what it includes in its place, and --help after them; offsets count from
// the command's struct, and each row has its group's number of arguments. `rows` has room for
// RG_MAX_OPTION_ROWS. Returns how many there are.
int rg_option_rows(const struct rg_option *table, struct rg_option *rows);

// What stands for a row's value, "md|csv|json|tex" where it is chosen; "" if it takes none.
const char *rg_option_argument(const struct rg_option *row, char text[RG_ARGUMENT_SIZE]);

// What a row means, with its default.
const char *rg_option_about(const struct rg_option *row, char text[RG_ABOUT_SIZE]);

// Makes the value of a row in a zeroed struct that of an option which was not given and has no
// default.
void rg_option_clear(const struct rg_option *row, void *values);
// Sets it to what `text` says, as the user or a default writes it. False, and one logged line,
// which names the command's help where that explains more, when it is refused.
bool rg_option_set(const struct rg_option *row, void *values, const char *text,
                   const char *command);
// Frees what the value owns.
void rg_option_free(const struct rg_option *row, void *values);

#endif
