// An asset's contents on the host, for comparing instances.
#ifndef RG_CORE_TECHNIQUES_STAGES_CONTENTS_H
#define RG_CORE_TECHNIQUES_STAGES_CONTENTS_H

#include "core/techniques/stages/instance.h"

// A copy of an asset's words, which may outlive the asset. Zeroed: none.
struct rg_contents {
    struct rg_image_desc desc; // of an image; a buffer has no levels
    size_t size;               // in bytes
    void *bytes; // owned; an image's level 0 of all layers, then level 1, rows without padding
};

// The bytes of an image's contents.
size_t rg_contents_size(const struct rg_image_desc *desc);

// Reads an asset that has an object. False, and one logged line, on failure; free the contents in
// either case.
bool rg_contents_read(const struct rg_asset *asset, struct rg_contents *contents);
// Writes contents back into an image of the same description. False, and one logged line, on
// failure.
bool rg_contents_write(const struct rg_contents *contents, struct rg_image *image);
void rg_contents_free(struct rg_contents *contents);

// A hash; equal contents have equal hashes.
uint64_t rg_contents_hash(const struct rg_contents *contents);

// Describes the first difference of two contents of one size, and the number of words that differ:
// "[17] is 0.5 (0x3f000000), not 0.25 (0x3e800000), off by 0.25; 3 of 64 words differ". A word that
// holds several numbers has them in brackets. A state's words have a column and a row; words of
// structs have a place in theirs; texels have x, y, layer and level. "" if nothing differs. A
// buffer's `state` gives its words, row and margin.
void rg_contents_describe(const struct rg_contents *contents, const struct rg_contents *expected,
                          const struct rg_state *state, char *text, size_t size);

// The kind of numbers in a word: one number, or as many as fit, the lowest bits first.
enum rg_number {
    RG_NUMBER_UINT,
    RG_NUMBER_INT,
    RG_NUMBER_FLOAT,
    RG_NUMBER_HALF,
    RG_NUMBER_CODE,  // of 8 bits
    RG_NUMBER_SMALL, // floats without a sign: two of 11 bits, then one of 10
};
// The kind of a word of contents: by the image's format, or by the words of the buffer's elements;
// an unsigned integer if these are not known.
enum rg_number rg_contents_number(const struct rg_contents *contents, const struct rg_state *state,
                                  int64_t word);
// The bits of the number that begins at bit `at` of a word.
int rg_number_bits(enum rg_number number, int at);

#endif
