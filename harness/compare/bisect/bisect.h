// Bisects a list: judges both ends, then the candidates between them by halving.
#ifndef RG_HARNESS_COMPARE_BISECT_BISECT_H
#define RG_HARNESS_COMPARE_BISECT_BISECT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "harness/compare/bisect/verdict.h"
#include "harness/compare/bisect/list.h"

enum rg_bisect_end {
    RG_BISECT_FOUND,    // one candidate is the first that is bad
    RG_BISECT_AMONG,    // one of several; all but the last of them were skipped
    RG_BISECT_GOOD_END, // the good end is not good
    RG_BISECT_BAD_END,  // the bad end is not bad
    RG_BISECT_STOPPED,  // the command could judge nothing, or was interrupted
};
enum { RG_BISECT_ENDS = RG_BISECT_STOPPED + 1 };

struct rg_bisect {
    const struct rg_candidates *candidates;
    const struct rg_judging *judging;
    bool prints; // prints each verdict as a line of text as it comes
    // Results.
    enum rg_judgement *verdicts; // one per candidate
    struct rg_judged *judged;    // in the order in which they were judged
    int64_t count;               // of these
    enum rg_bisect_end end;
    int64_t good, bad; // last good and first bad candidate; the change lies between them
};

// Runs the bisect. Returns an enum rg_exit: pass if one candidate is found, inconclusive for
// several, fail if an end is not as expected, nothing measured if an end cannot be judged, usage if
// the command is wrong. The caller calls rg_bisect_free in any case.
int rg_bisect_run(struct rg_bisect *bisect);
void rg_bisect_free(struct rg_bisect *bisect);

// Print a verdict as a line of text; the result as text; and as "bisect" of
// docs/records.schema.json.
void rg_bisect_print_verdict(const struct rg_bisect *bisect, const struct rg_judged *judged);
void rg_bisect_print_end(const struct rg_bisect *bisect);
bool rg_bisect_print_json(const struct rg_bisect *bisect, FILE *out);

#endif
