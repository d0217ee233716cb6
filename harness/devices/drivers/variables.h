// Variables for a worker's process while they are gathered: "KEY=value", each ended by a zero, the
// last by two (harness/devices/workers/environment.h).
#ifndef RG_HARNESS_DEVICES_DRIVERS_VARIABLES_H
#define RG_HARNESS_DEVICES_DRIVERS_VARIABLES_H

#include <stdbool.h>
#include <stddef.h>

// Zeroed: none. The owner calls rg_variables_free.
struct rg_worker_variables {
    char *text; // NULL: none, or no memory
    size_t size;
    bool failed; // there was no memory
};

// Sets a variable, in the place of what it was before. Returns false without memory.
bool rg_variables_set(struct rg_worker_variables *variables, const char *key, const char *value);
// Takes one away that was set here.
void rg_variables_drop(struct rg_worker_variables *variables, const char *key);
// What the worker will have: what is set here, or this process's own; NULL: neither.
const char *rg_variables_find(const struct rg_worker_variables *variables, const char *key);
void rg_variables_free(struct rg_worker_variables *variables);

#endif
