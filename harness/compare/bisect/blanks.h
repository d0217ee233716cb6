// The command of a bisect: a line for the shell, which variables hand each candidate to.
//
// The shell takes a variable in quotes for one word, whatever characters it has, so that no name of
// a candidate is ever read as code. "{}", "{good}" and "{budget}" are short for such variables.
#ifndef RG_HARNESS_COMPARE_BISECT_BLANKS_H
#define RG_HARNESS_COMPARE_BISECT_BLANKS_H

#include <stdbool.h>

#define RG_VARIABLE_CANDIDATE "RG_CANDIDATE"
#define RG_VARIABLE_GOOD      "RG_GOOD"
#define RG_VARIABLE_BUDGET    "RG_BUDGET"

// The line with its variable in the place of each blank, which the caller frees. "{}" and "{good}"
// stay as they are where there are no candidates. NULL, and one logged line, where it is not
// certain that the shell takes a blank for one word, where the line gets too long for the system,
// and without memory.
char *rg_blanks_fill(const char *line, bool has_candidates);

#endif
