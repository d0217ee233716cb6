// Which candidate of a bisect is judged next, and what the verdicts come to.
#ifndef RG_HARNESS_COMPARE_BISECT_SEARCH_H
#define RG_HARNESS_COMPARE_BISECT_SEARCH_H

#include <stdint.h>

#include "harness/compare/bisect/verdict.h"

// What is known of candidates that stand in order, from a good end to a bad one.
struct rg_search {
    int64_t good; // the last that is good
    int64_t bad;  // the first behind it that is bad
    int64_t left; // not judged, between the two
};

// `verdicts` has one of each candidate, of which the first is good and the last bad.
struct rg_search rg_search_of(const enum rg_judgement *verdicts, int64_t count);

// The next to judge: the middle of the longest stretch between `good` and `bad` that is not judged,
// the one nearest to the middle of all among equals. So halving goes by halves where nothing is
// skipped, and leaves a stretch that cannot be judged in leaps. -1: all are.
int64_t rg_search_next(const struct rg_search *search, const enum rg_judgement *verdicts);

// How many more are judged at most, if none is skipped.
int rg_search_steps(const struct rg_search *search);

#endif
