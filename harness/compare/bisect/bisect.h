// Bisects a list: judges both ends, then the candidates between them by halving.
#ifndef RG_HARNESS_COMPARE_BISECT_BISECT_H
#define RG_HARNESS_COMPARE_BISECT_BISECT_H

#include <stdio.h>

#include "harness/compare/bisect/verdict.h"
#include "core/base/files/lines.h"

// --- candidates, in order ---

struct rg_candidates {
    int64_t count, room;
    const char **names;    // from the good end to the bad one; not owned
    struct rg_lines lines; // memory of names from a file
};

// Adds a candidate, or a file's lines that are neither blank nor comments, without blanks around
// them. False, and one logged line, if a name cannot be one. `candidates` is zeroed before; after
// any function here the caller calls rg_candidates_free.
bool rg_candidates_add(const char *name, struct rg_candidates *candidates);
bool rg_candidates_read(const char *path, struct rg_candidates *candidates);
// The first name added is the good end, and the last the bad one. If both ends are among the names
// between, only the part from one to the other stays; such a list may have the newest first. False,
// and one logged line, if only one end is among them, if both ends are the same, or if a candidate
// is listed twice.
bool rg_candidates_between(struct rg_candidates *candidates);
void rg_candidates_free(struct rg_candidates *candidates);

// --- the search ---

struct rg_search {
    int64_t good; // last candidate that is good
    int64_t bad;  // first bad candidate after it
    int64_t left; // number of unjudged candidates between the two
    int64_t next; // to be judged next; -1: all are judged
    int steps;    // at most so many more are judged if none is skipped
};
// `verdicts` has one per candidate; the first is good and the last bad. The next is the middle of
// the longest unjudged stretch between `good` and `bad`; of equal ones, the one nearest to the
// centre. So the search soon leaves a stretch that cannot be judged.
struct rg_search rg_search_of(const enum rg_judgement *verdicts, int64_t count);

// --- the bisect ---

struct rg_bisect {
    const struct rg_candidates *candidates;
    const struct rg_judging *judging;
    bool prints; // prints each verdict and the result as lines of text
    // Results.
    enum rg_judgement *verdicts; // one per candidate
    struct rg_judged *judged;    // in the order in which they were judged
    int64_t count;               // of these
    const char *end;             // "end" in docs/records.schema.json
    struct rg_search found;      // the change lies between its good and its bad one
};

// Runs the bisect. Returns an enum rg_exit: pass if one candidate is found, inconclusive for
// several, fail if an end has the wrong verdict, nothing measured if an end cannot be judged, usage
// if the command is wrong. The caller calls rg_bisect_free in any case.
int rg_bisect_run(struct rg_bisect *bisect);
void rg_bisect_free(struct rg_bisect *bisect);
// Prints "bisect" of docs/records.schema.json.
bool rg_bisect_print_json(const struct rg_bisect *bisect, FILE *out);

#endif
