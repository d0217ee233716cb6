// Exit statuses for `git bisect run`: 1 to 127 mean bad, except 125, which means skip; higher ones
// end the bisect (git-bisect(1)).
#ifndef RG_HARNESS_COMPARE_BISECT_GIT_H
#define RG_HARNESS_COMPARE_BISECT_GIT_H

#include "harness/compare/bisect/verdict.h"

// The exit status for a verdict; stop ends git's bisect.
int rg_git_status(enum rg_judgement verdict);

// The exit status for bad usage. While git bisects the repository of the current folder it is that
// of stop; otherwise git would take a misspelt option for a bad commit at every step.
int rg_git_status_of_usage(void);

#endif
