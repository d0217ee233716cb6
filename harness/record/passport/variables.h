// The variables that change what runs, where, or on how many threads. Only these are recorded.
#ifndef RG_HARNESS_RECORD_PASSPORT_VARIABLES_H
#define RG_HARNESS_RECORD_PASSPORT_VARIABLES_H

#include <stdbool.h>

struct rg_variable {
    const char *name;
    bool is_of_speed; // it changes how fast the same driver is, and not which driver runs
};
extern const struct rg_variable rg_variables[]; // the last has no name

bool rg_variable_is_of_speed(const char *name);

#endif
