// Claims of papers about their tables, and their verdicts from results.
#ifndef RG_HARNESS_TABLES_CLAIMS_CLAIM_H
#define RG_HARNESS_TABLES_CLAIMS_CLAIM_H

#include "harness/record/result.h"

enum rg_claim_source {
    RG_CLAIM_SAID,    // a sentence of the paper
    RG_CLAIM_PRINTED, // a property of its table, whether the paper mentions it or not
};

// The test of a claim. Rows are numbered from 1 as in the table. All compare frame rates, except
// FLATTENS, which compares errors of images.
enum rg_claim_test {
    RG_CLAIM_FALLS, // from row `first` to `last` frames get slower: as a trend, by RG_CLAIM_FALL in
                    // all at least, and no row is faster than the one before it by more than
                    // RG_CLAIM_REVERSAL
    RG_CLAIM_ORDER, // rows `first` to `last` have the order of print
    RG_CLAIM_RATIO, // row `first` is at least `least` times as fast as row `last`
    RG_CLAIM_TIMES, // row `first` is from `least` to `most` times as fast as row `last`
    RG_CLAIM_ALIKE, // no two of rows `first` to `last` differ by a factor of more than `most`
    RG_CLAIM_APART, // some two of them differ by a factor of more than `least`
    RG_CLAIM_EXPONENT, // frame rates follow a power of the axis from `least` to `most`
    RG_CLAIM_FASTER,   // in each row `variant` is at least `least` times as fast as `other`
    RG_CLAIM_RATE,     // in each row the frame rate is at least `least`
    RG_CLAIM_OPTIMUM,  // the fastest of rows `first` to `last` is one of `knee` to `until`
    RG_CLAIM_SLOWEST,  // row `knee` is slower than every other of rows `first` to `last`
    RG_CLAIM_CROSSES,  // `variant` is slower than `other` before row `knee`, and faster from there
    RG_CLAIM_FLATTENS, // from row `first` to `knee` the error falls, and at least `least` times as
                       // much as from `knee` to `last`
};

// The tests' names, and which of a claim's members each needs beside rows and a variant.
enum {
    RG_CLAIM_LEAST = 1,
    RG_CLAIM_MOST = 2,
    RG_CLAIM_KNEE = 4,
    RG_CLAIM_OTHER = 8,
};
struct rg_claim_form {
    const char *name; // "falls"
    int needs;
};
enum { RG_CLAIM_TESTS = RG_CLAIM_FLATTENS + 1 };
extern const struct rg_claim_form rg_claim_forms[RG_CLAIM_TESTS]; // by rg_claim_test

// RG_CLAIM_FALL is the least whole value of FALLS, since enough launches find any fall.
// RG_CLAIM_REVERSAL is the largest rise between neighbouring rows. Creus's words allow a tenth: he
// calls a table a decrease in which one row is 1.09 times as fast as the one before it (table 5.3,
// second camera, 5 and 10 m).
#define RG_CLAIM_FALL     1.05
#define RG_CLAIM_REVERSAL 1.1

struct rg_claim {
    const char *table;   // "creus-5.4"
    const char *variant; // "full"
    const char *other;   // a second variant, or NULL
    enum rg_claim_source source;
    const char *where; // "5.2.2": the section
    const char *words; // the paper's own words, or the property, in one line
    enum rg_claim_test test;
    int first, last; // rows
    int knee;        // a row
    int until;       // a later row, the end of the range; 0: the knee itself
    double least, most;
    bool is_ours;     // the paper gives no number, so that the bounds are ours
    bool can_wait;    // within a budget its variants come with all others
    const char *part; // the part of the paper's words that is tested, in ours; NULL: all
};

// Whether the claim is about each row separately, so that measured rows can be judged without the
// others.
bool rg_claim_is_of_each_row(const struct rg_claim *claim);

enum { RG_CLAIM_TITLE = 160 };
// The title, with only the paper's own words in quotation marks: "\"25% slower\", at least".
void rg_claim_title(const struct rg_claim *claim, char title[RG_CLAIM_TITLE]);
enum { RG_CLAIM_ID = 192 };
// The id, from table and title, in lower-case letters, digits and separators:
// "stuppacher-1/complex-models-25-slower-at-least". It is unique.
void rg_claim_id(const struct rg_claim *claim, char id[RG_CLAIM_ID]);

// All claims, by table, of papers and of files that were read; the last has no table.
extern const struct rg_claim *rg_claims;

enum rg_claim_verdict {
    RG_CLAIM_REPRODUCED,
    RG_CLAIM_NOT_REPRODUCED,
    RG_CLAIM_AT_BOUND,   // its interval lies within 1.05 of the bound, and contains it
    RG_CLAIM_UNDECIDED,  // the launches do not decide it
    RG_CLAIM_OTHER_WORK, // the measured work is not the printed one
    RG_CLAIM_NOT_SEEN,   // rows or variants are missing
    RG_CLAIM_ONE_LAUNCH, // no verdict: there are figures of one launch alone
    RG_CLAIM_VERDICTS
};
const char *rg_claim_verdict_text(enum rg_claim_verdict verdict);
// Whether launches decided it: the first three.
bool rg_claim_is_decided(enum rg_claim_verdict verdict);

// The result of the medians of one launch. It decides nothing: the next launch may give the
// opposite.
enum rg_claim_figures {
    RG_FIGURES_FIT,  // the claim holds by them
    RG_FIGURES_MISS, // it does not
    RG_FIGURES_NEAR, // they are within 1.05 of the bound
    RG_FIGURES_NONE, // not seen, or other work
    RG_FIGURES_COUNT
};

enum { RG_REASON_SIZE = 640 }; // room for the names of two rows

struct rg_judgement {
    enum rg_claim_verdict verdict;
    enum rg_claim_figures figures;
    int launches;  // launches that count
    int disturbed; // launches that do not, because others used the machine
    int more;   // launches to take until the next look; 0: the verdict stands, or no look is left
    int needed; // if undecided: launches, counted from the first, that would probably decide
    double launch_s;          // time that a launch of the claim's cells takes; 0: unknown
    bool print_contradicts;   // the paper's own numbers contradict it
    int rows, rows_needed;    // rows judged, and rows of the claim
    char why[RG_REASON_SIZE]; // one sentence
};

// The verdict in words; for figures of one launch: "one launch: fits".
const char *rg_judgement_text(const struct rg_judgement *judgement);

// Judges a claim by its table's result on one device: by launches, if the result has any, at 1 %
// two-sided (docs/claims.md). Errors of images are the same in each launch and need none.
struct rg_judgement rg_claim_judge(const struct rg_claim *claim, const struct rg_result *result,
                                   int device);

// Whether a row's variant is timed for the claim.
bool rg_claim_needs(const struct rg_claim *claim, int row, const char *variant);

#endif
