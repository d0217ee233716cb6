// What `git bisect run` makes of an exit status: 1 to 127 are bad, but 125 is skip, and it ends
// above that (git-bisect(1)).
#ifndef RG_HARNESS_COMPARE_BISECT_GIT_H
#define RG_HARNESS_COMPARE_BISECT_GIT_H

#include "harness/compare/bisect/verdict.h"

// The exit status that tells git a verdict; stop ends its search.
int rg_git_status(enum rg_judgement verdict);

// The exit status of bad usage: the usual one, but where git bisects the repository of the current
// folder, that of stop, for git would find a misspelt option bad all the way down.
int rg_git_status_of_usage(void);

#endif
