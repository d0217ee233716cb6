// The search of a bisect: which candidate is judged next, and what is known so far.
#ifndef RG_HARNESS_COMPARE_BISECT_SEARCH_H
#define RG_HARNESS_COMPARE_BISECT_SEARCH_H

#include <stdint.h>

#include "harness/compare/bisect/verdict.h"

// State of the search over candidates in order, from a good end to a bad one.
struct rg_search {
    int64_t good; // last candidate that is good
    int64_t bad;  // first bad candidate after it
    int64_t left; // number of candidates between the two that are not judged
};

// `verdicts` has one per candidate; the first is good and the last bad.
struct rg_search rg_search_of(const enum rg_judgement *verdicts, int64_t count);

// The next candidate to judge: the middle of the longest unjudged stretch between `good` and `bad`;
// of equal ones, the one nearest to the centre. Without skips this is a bisection, and a stretch
// that cannot be judged is left in leaps. -1: all are judged.
int64_t rg_search_next(const struct rg_search *search, const enum rg_judgement *verdicts);

// How many more candidates are judged at most if none is skipped.
int rg_search_steps(const struct rg_search *search);

#endif
