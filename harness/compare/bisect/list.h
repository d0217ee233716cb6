// The candidates of a bisect, in order.
#ifndef RG_HARNESS_COMPARE_BISECT_LIST_H
#define RG_HARNESS_COMPARE_BISECT_LIST_H

#include <stdbool.h>
#include <stdint.h>

#include "harness/compare/gate/text/lines.h"

struct rg_candidates {
    int64_t count, room;
    const char **names;    // from the good end to the bad one; not owned
    struct rg_lines lines; // what those of a file lie in
};

// Adds the lines of a text file that say something (harness/compare/gate/text/lines.h), without the
// blanks around them. `candidates` is zeroed before; the caller calls rg_candidates_free in any
// case, of all functions here.
bool rg_candidates_read(const char *path, struct rg_candidates *candidates);
bool rg_candidates_add(const char *name, struct rg_candidates *candidates);

// Keeps what lies from `good` to `bad`, in this direction: a list may have the newest first. Where
// it has neither they stand around it. False, and one logged line, where it has one of them alone,
// where they are the same, or where a candidate stands there twice.
bool rg_candidates_between(const char *good, const char *bad, struct rg_candidates *candidates);
void rg_candidates_free(struct rg_candidates *candidates);

#endif
