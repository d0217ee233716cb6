// What an asset holds, brought to the host, so that instances can be compared.
#ifndef RG_CORE_TECHNIQUES_STAGES_CONTENTS_H
#define RG_CORE_TECHNIQUES_STAGES_CONTENTS_H

#include "core/techniques/stages/instance.h"

// A copy of an asset's words, which outlives the asset. Zeroed: none.
struct rg_contents {
    struct rg_image_desc desc; // of an image; a buffer has no levels
    size_t size;               // in bytes
    void *bytes; // owned. Of an image: level 0 of all layers, then level 1, rows without padding
};

// The bytes of an image's contents.
size_t rg_contents_size(const struct rg_image_desc *desc);

// Reads an asset that has been made. False, and one logged line, on failure; to be freed in either
// case.
bool rg_contents_read(const struct rg_asset *asset, struct rg_contents *contents);
// Writes what an image of the same description held. False, and one logged line, on failure.
bool rg_contents_write(const struct rg_contents *contents, struct rg_image *image);
void rg_contents_free(struct rg_contents *contents);

// What identifies the contents; equal contents have equal ones.
uint64_t rg_contents_hash(const struct rg_contents *contents);

// Where two of one size differ first, by how much, and in how many words: "[17] is 0.5
// (0x3f000000), not 0.25 (0x3e800000), off by 0.25; 3 of 64 words differ". A state's words have a
// column and a row; texels have x, y, layer and level. "" where nothing differs. `state` is of the
// buffer, or NULL.
void rg_contents_describe(const struct rg_contents *contents, const struct rg_contents *expected,
                          const struct rg_state *state, char *text, size_t size);

// Whether a word counts as a float: by the image's format, by what is known of the state, or, where
// nothing tells, by its bits.
bool rg_contents_has_float(const struct rg_contents *contents, const struct rg_state *state,
                           uint32_t bits);

#endif
