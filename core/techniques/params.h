// A technique's named parameters, each with unit, range, default and a line of documentation.
//
// A technique declares a table of them. Each row says where its value lies in the technique's
// settings struct, so that code reads plain fields and the command line reads and writes by name.
#ifndef RG_CORE_TECHNIQUES_PARAMS_H
#define RG_CORE_TECHNIQUES_PARAMS_H

#include <stdbool.h>
#include <stddef.h>

enum { RG_PATH_SIZE = 1024 };

enum rg_param_kind {
    RG_PARAM_INT,    // an int
    RG_PARAM_FLOAT,  // a double
    RG_PARAM_CHOICE, // an int, an index into `choices`
    RG_PARAM_FILE,   // a char[RG_PATH_SIZE]: a path or a name, "" for none
};

struct rg_param {
    const char *name;
    enum rg_param_kind kind;
    size_t offset;     // of the value in the settings
    double initial;    // default of all kinds except RG_PARAM_FILE
    double min, max;   // inclusive, for numbers
    const char *unit;  // "px", "mm", "1"
    const char *about; // one line
    const char *text;  // the choices, separated by spaces; or the default of an RG_PARAM_FILE
};

struct rg_param_table {
    const char *technique; // for messages
    const struct rg_param *rows;
    int count;
    size_t settings_size;
    // The parameter whose choices stand for other assignments, and the assignments of each,
    // "key=value key=value". Later assignments override them. NULL: there is none.
    const char *preset;
    const char *const *presets;
};

// Sets every parameter to its default.
void rg_params_reset(const struct rg_param_table *table, void *settings);

// Parses and applies "key=value". False, with one line that names the mend, for an unknown key, a
// value that is no number, out of range or no choice, or a path too long.
bool rg_params_set(const struct rg_param_table *table, void *settings, const char *assignment);

// Parses and applies a value of this parameter only: a preset's assignments are not made.
bool rg_params_set_one(const struct rg_param *param, void *settings, const char *value);

// The same for several assignments, separated by spaces.
bool rg_params_set_all(const struct rg_param_table *table, void *settings, const char *assignments);

// Prints a value in the form that rg_params_set accepts.
void rg_params_text(const struct rg_param *param, const void *settings, char *text, size_t size);

// The row of this name, or NULL.
const struct rg_param *rg_params_find(const struct rg_param_table *table, const char *name);

#endif
