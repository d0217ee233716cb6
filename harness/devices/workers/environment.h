// Variables in addition to a process's environment: "KEY=value", each ended by a zero, the last by
// two.
#ifndef RG_HARNESS_DEVICES_WORKERS_ENVIRONMENT_H
#define RG_HARNESS_DEVICES_WORKERS_ENVIRONMENT_H

// A copy, which the caller frees; NULL gives an empty one. NULL when memory runs out, without a
// message.
char *rg_environment_copy(const char *variables);

// This process's environment with the variables added or replaced, for a program to be started: an
// array that the caller frees, without its texts. NULL when memory runs out, without a message.
char **rg_environment_with(char *variables);

// A variable's value, valid as long as `variables`; NULL: it is not among them.
const char *rg_environment_find(const char *variables, const char *key);

#endif
