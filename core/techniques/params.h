// Named parameters of a technique: unit, range, default and a line of documentation each.
//
// A technique declares a table of them; each row says where its value lies in the technique's own
// settings struct, so that code reads plain fields and the command line reads and writes by name.
#ifndef RG_CORE_TECHNIQUES_PARAMS_H
#define RG_CORE_TECHNIQUES_PARAMS_H

#include <stdbool.h>
#include <stddef.h>

enum { RG_PATH_SIZE = 1024 };

enum rg_param_kind {
    RG_PARAM_INT,    // an int
    RG_PARAM_FLOAT,  // a double
    RG_PARAM_CHOICE, // an int, the index among `choices`
    RG_PARAM_FILE,   // a char[RG_PATH_SIZE]: a path or a name, "" for none
};

struct rg_param {
    const char *name;
    enum rg_param_kind kind;
    size_t offset;     // of the value in the settings
    double initial;    // default, for all kinds but RG_PARAM_FILE
    double min, max;   // inclusive, for numbers
    const char *unit;  // "px", "mm", "1"
    const char *about; // one line
    const char *text;  // the choices, separated by spaces; or the default of a RG_PARAM_FILE
};

struct rg_param_table {
    const char *technique; // for messages
    const struct rg_param *rows;
    int count;
    size_t settings_size;
    // A parameter whose choices stand for other assignments, and what each assigns, "key=value
    // key=value". What is assigned after it stands over that. NULL: there is none.
    const char *preset;
    const char *const *presets;
};

// Sets every parameter to its default.
void rg_params_reset(const struct rg_param_table *table, void *settings);

// Takes "key=value". False, with one line that names the mend: an unknown key, a value that is no
// number, out of range or no choice, a path too long.
bool rg_params_set(const struct rg_param_table *table, void *settings, const char *assignment);

// Takes a value of this parameter alone: that of a preset assigns nothing else.
bool rg_params_set_one(const struct rg_param *param, void *settings, const char *value);

// Takes several, separated by spaces.
bool rg_params_set_all(const struct rg_param_table *table, void *settings, const char *assignments);

// Writes a value as rg_params_set would take it.
void rg_params_text(const struct rg_param *param, const void *settings, char *text, size_t size);

// The row of this name, or NULL.
const struct rg_param *rg_params_find(const struct rg_param_table *table, const char *name);

#endif
