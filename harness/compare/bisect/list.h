// The candidates of a bisect, in order.
#ifndef RG_HARNESS_COMPARE_BISECT_LIST_H
#define RG_HARNESS_COMPARE_BISECT_LIST_H

#include <stdbool.h>
#include <stdint.h>

#include "harness/compare/text/lines.h"

struct rg_candidates {
    int64_t count, room;
    const char **names;    // from the good end to the bad one; not owned
    struct rg_lines lines; // memory of names from a file
};

// Adds the lines of a text file that are neither blank nor comments
// (harness/compare/text/lines.h), without blanks around them. `candidates` is zeroed before;
// after any function here the caller calls rg_candidates_free.
bool rg_candidates_read(const char *path, struct rg_candidates *candidates);
bool rg_candidates_add(const char *name, struct rg_candidates *candidates);

// Keeps the candidates from `good` to `bad`; a list may also have the newest first. If it has
// neither, they are added as its ends. False, and one logged line, if it has only one of them, if
// both are the same, or if a candidate is listed twice.
bool rg_candidates_between(const char *good, const char *bad, struct rg_candidates *candidates);
void rg_candidates_free(struct rg_candidates *candidates);

#endif
