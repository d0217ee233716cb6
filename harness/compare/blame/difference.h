// What kind of difference lies between what two devices left in one asset: a clue to its cause.
#ifndef RG_HARNESS_COMPARE_BLAME_DIFFERENCE_H
#define RG_HARNESS_COMPARE_BLAME_DIFFERENCE_H

#include "core/techniques/stages/contents.h"

// In the order in which they are tried: the first that fits names the difference.
enum rg_difference {
    RG_DIFFERENCE_NONE,
    RG_DIFFERENCE_SIZE,      // one holds more than the other
    RG_DIFFERENCE_NAN,       // a value is NaN or infinite in one of the two alone
    RG_DIFFERENCE_MISSING,   // where they differ, the stage has left what was there before
    RG_DIFFERENCE_SURPLUS,   // likewise, but the truth is what was there before
    RG_DIFFERENCE_ORDER,     // a buffer has the same elements in another order
    RG_DIFFERENCE_LAST_BITS, // floats a few steps from each other, or codes of 8 bits one
    RG_DIFFERENCE_EDGE,      // texels that the other image has within a texel of there
    RG_DIFFERENCE_VALUES,    // none of these
    RG_DIFFERENCE_COUNT
};

// "last-bits", as texts of cases have it.
const char *rg_difference_name(enum rg_difference difference);
// "in the last bits": a few words for a sentence.
const char *rg_difference_words(enum rg_difference difference);
// The difference of this name; RG_DIFFERENCE_NONE where there is none.
enum rg_difference rg_difference_find(const char *name);

// The first word in which two differ, and in how many they do; both are read as far as the shorter.
struct rg_differing {
    int64_t first, count;
};

// What kind it is. `before` is what both had before the stage, or zeroed where that is not known;
// `state` tells of a buffer what its words are.
enum rg_difference rg_difference_of(const struct rg_contents *contents,
                                    const struct rg_contents *expected,
                                    const struct rg_contents *before, const struct rg_state *state,
                                    struct rg_differing *differing);

// The bytes of a buffer's element.
int rg_difference_element(const struct rg_state *state);

#endif
