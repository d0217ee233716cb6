// What papers claim about their tables, and whether a result bears it out.
#ifndef RG_HARNESS_TABLES_CLAIMS_CLAIM_H
#define RG_HARNESS_TABLES_CLAIMS_CLAIM_H

#include "harness/record/result.h"

enum rg_claim_source {
    RG_CLAIM_SAID,    // a sentence of the paper
    RG_CLAIM_PRINTED, // what its table shows, whether it says so or not
};

// How a claim is put to the test. Rows are counted from 1, as the table has them. All compare frame
// rates but FLATTENS, which compares the images' errors.
enum rg_claim_test {
    RG_CLAIM_FALLS,    // each of rows `first` to `last` is slower than the one before it
    RG_CLAIM_ORDER,    // rows `first` to `last` stand in the order of print
    RG_CLAIM_RATIO,    // row `first` is at least `least` times as fast as row `last`
    RG_CLAIM_ALIKE,    // no two of rows `first` to `last` are more than `most` times apart
    RG_CLAIM_APART,    // some two of them are more than `least` times apart
    RG_CLAIM_EXPONENT, // frame rates go with the axis to a power from `least` to `most`
    RG_CLAIM_FASTER,   // in each row `variant` is at least `least` times as fast as `other`
    RG_CLAIM_RATE,     // in each row the frame rate is at least `least`
    RG_CLAIM_OPTIMUM,  // the fastest of rows `first` to `last` is one of `knee` to `until`
    RG_CLAIM_SLOWEST,  // row `knee` is slower than each other of rows `first` to `last`
    RG_CLAIM_CROSSES,  // `variant` is slower than `other` before row `knee`, and faster from there
    RG_CLAIM_FLATTENS, // from row `first` to `knee` the error falls at least `least` times as far
                       // as from there to row `last`
};

struct rg_claim {
    const char *table;   // "creus-5.4"
    const char *variant; // "full"
    const char *other;   // a second variant, or NULL
    enum rg_claim_source source;
    const char *where; // "5.2.2": the section
    const char *words; // the paper's own, or what its table shows, in one line
    enum rg_claim_test test;
    int first, last; // rows
    int knee;        // a row
    int until;       // a row behind it; 0: the knee itself
    double least, most;
    const char *part; // that part of the paper's words, in ours; NULL: all of them
};

// Whether each row stands for itself, so that those that are measured can be judged.
bool rg_claim_is_of_each_row(const struct rg_claim *claim);

enum { RG_CLAIM_TITLE = 160 };
// "\"25% slower\", at least": the paper's own words in quotation marks, and nothing else in them.
void rg_claim_title(const struct rg_claim *claim, char title[RG_CLAIM_TITLE]);
enum { RG_CLAIM_ID = 192 };
// "stuppacher-1/complex-models-25-slower-at-least": its table and its title, of small letters,
// digits and what parts them. No other claim has it.
void rg_claim_id(const struct rg_claim *claim, char id[RG_CLAIM_ID]);

// All claims, by table; the last has no table.
extern const struct rg_claim rg_claims[];

enum rg_claim_verdict {
    RG_CLAIM_REPRODUCED,
    RG_CLAIM_NOT_REPRODUCED,
    RG_CLAIM_UNDECIDED,  // the samples do not settle it, or rows are missing
    RG_CLAIM_OTHER_WORK, // what was measured is not what was printed
    RG_CLAIM_VERDICTS
};
const char *rg_claim_verdict_text(enum rg_claim_verdict verdict);

enum { RG_REASON_SIZE = 512 }; // the names of two rows fit

struct rg_judgement {
    enum rg_claim_verdict verdict;
    // Probabilities of samples as far from the opposite as these, were the opposite true: that the
    // claim does not hold, and that it holds. NAN where there are no samples.
    double against, in_favour;
    bool print_contradicts;   // the paper's own numbers do not bear it out
    int rows, rows_needed;    // those that it was judged by, of the claim's
    char why[RG_REASON_SIZE]; // one sentence
};

// The probability behind a verdict: against the claim where it is not reproduced, else for it.
double rg_claim_probability(const struct rg_judgement *judgement);

// Judges a claim by the result of its table, on one of its devices. A verdict is given where the
// samples settle it with 95 % confidence for the claim as a whole (docs/claims.md).
struct rg_judgement rg_claim_judge(const struct rg_claim *claim, const struct rg_result *result,
                                   int device);

#endif
