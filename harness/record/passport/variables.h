// The environment variables that change which code runs, where, or on how many threads; only these
// are recorded.
#ifndef RG_HARNESS_RECORD_PASSPORT_VARIABLES_H
#define RG_HARNESS_RECORD_PASSPORT_VARIABLES_H

#include <stdbool.h>

struct rg_variable {
    const char *name;
    bool is_of_speed; // it affects the speed of the same driver, not the choice of the driver
};
extern const struct rg_variable rg_variables[]; // the last has no name

bool rg_variable_is_of_speed(const char *name);

#endif
