// Classifies the difference between two devices' contents of one asset, as a clue to its cause.
#ifndef RG_HARNESS_COMPARE_BLAME_DIFFERENCE_H
#define RG_HARNESS_COMPARE_BLAME_DIFFERENCE_H

#include "core/techniques/stages/contents.h"

// In the order of the tests; the first match counts.
enum rg_difference {
    RG_DIFFERENCE_NONE,
    RG_DIFFERENCE_SIZE,      // their sizes differ
    RG_DIFFERENCE_NAN,       // a value is NaN or infinite in only one of them
    RG_DIFFERENCE_MISSING,   // at all differences, the stage has kept the earlier value
    RG_DIFFERENCE_SURPLUS,   // likewise, but the truth is the earlier value
    RG_DIFFERENCE_ORDER,     // a buffer has the same elements in another order
    RG_DIFFERENCE_LAST_BITS, // floats a few units in the last place apart, or 8-bit codes one
    RG_DIFFERENCE_EDGE,      // each texel occurs in the other image within a texel of its place
    RG_DIFFERENCE_VALUES,    // none of these
    RG_DIFFERENCE_COUNT
};

// "last-bits": the name in texts of cases.
const char *rg_difference_name(enum rg_difference difference);
// "in the last bits": words for a sentence.
const char *rg_difference_words(enum rg_difference difference);
// The difference of this name; RG_DIFFERENCE_NONE if there is none.
enum rg_difference rg_difference_find(const char *name);

// The first differing word, and the number of differing words, within the shorter of the two.
struct rg_differing {
    int64_t first, count;
};

// The kind of a difference. `before` is what both had before the stage, or zeroed if unknown;
// `state` describes the words of a buffer.
enum rg_difference rg_difference_of(const struct rg_contents *contents,
                                    const struct rg_contents *expected,
                                    const struct rg_contents *before, const struct rg_state *state,
                                    struct rg_differing *differing);

// The bytes of a buffer's element.
int rg_difference_element(const struct rg_state *state);

#endif
