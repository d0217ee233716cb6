// Variables over a process's environment: "KEY=value" each, ended by a zero, the last by two.
#ifndef RG_HARNESS_DEVICES_WORKERS_ENVIRONMENT_H
#define RG_HARNESS_DEVICES_WORKERS_ENVIRONMENT_H

// A copy, which the caller frees; of NULL, an empty one. NULL without memory, and nothing is
// logged.
char *rg_environment_copy(const char *variables);

// This process's environment with the variables over it, for a program that is started: an array
// that the caller frees, of texts that it does not. NULL without memory, and nothing is logged.
char **rg_environment_with(char *variables);

// A variable's value, which lives as long as `variables`; NULL: it is not among them.
const char *rg_environment_find(const char *variables, const char *key);

#endif
