// The command of a bisect: a line for the shell, with blanks that each candidate fills.
#ifndef RG_HARNESS_COMPARE_BISECT_BLANKS_H
#define RG_HARNESS_COMPARE_BISECT_BLANKS_H

#include <stdbool.h>

// What stands for "{}", "{good}" and "{budget}"; NULL: that blank stays as it is.
struct rg_blanks {
    const char *candidate, *good, *budget;
};

// The line with its blanks filled, which the caller frees. The shell takes what is filled in for
// the very text, whatever characters it has: it is quoted where it stands in no quotes, and has its
// marks escaped where it stands in quotes of the line's. NULL, and one logged line, without memory.
char *rg_blanks_fill(const char *line, const struct rg_blanks *blanks);

#endif
