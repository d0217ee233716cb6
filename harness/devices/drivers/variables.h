// Collects variables for a worker's process: "KEY=value", each ended by a zero, the last by two
// (harness/devices/workers/environment.h).
#ifndef RG_HARNESS_DEVICES_DRIVERS_VARIABLES_H
#define RG_HARNESS_DEVICES_DRIVERS_VARIABLES_H

#include <stdbool.h>
#include <stddef.h>

// Zeroed: none. The owner calls rg_variables_free.
struct rg_worker_variables {
    char *text; // NULL: none, or no memory
    size_t size;
    bool failed; // memory ran out
};

// Sets a variable, replacing an earlier value. False when memory runs out.
bool rg_variables_set(struct rg_worker_variables *variables, const char *key, const char *value);
// Removes a variable that was set here.
void rg_variables_drop(struct rg_worker_variables *variables, const char *key);
// The value in the worker: set here, or this process's own; NULL: neither.
const char *rg_variables_find(const struct rg_worker_variables *variables, const char *key);
void rg_variables_free(struct rg_worker_variables *variables);

#endif
