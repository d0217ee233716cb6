// Finds the first stage after which an asset's bits differ between two devices, one of which counts
// as the truth; and the place and the kind of the difference.
#ifndef RG_HARNESS_COMPARE_BLAME_BLAME_H
#define RG_HARNESS_COMPARE_BLAME_BLAME_H

#include <jansson.h>

#include "harness/compare/blame/difference.h"
#include "harness/devices/frames/digests.h"

// Zeroed: nothing differs.
struct rg_blame {
    bool found;
    bool is_alone;          // only one of them writes the asset, or their stages differ
    struct rg_digest first; // on the device; its stage is "" if opening already left other bits
    uint64_t expected;      // the hash on the other device; from here on unknown if is_alone
    enum rg_difference difference;
    bool is_image;
    int64_t item;             // for a buffer: the element
    int x, y;                 // for an image: the texel
    int layer, level;         // likewise
    int64_t differing, words; // of 4 bytes
    char text[600];           // a line: "frame 1, stage flow_normals: normals[17] is 0.5, ..."
};

// The first row in which the digests of two runs differ; -1: none.
int rg_blame_first(const struct rg_digests *digests, const struct rg_digests *expected);

// Describes the difference in a row, from further runs of both. False, with one logged line, if
// these fail; the text then has what is known.
bool rg_blame_row(const struct rg_digest_run *run, struct rg_device *device,
                  struct rg_device *truth, const struct rg_digests *digests,
                  const struct rg_digests *expected, struct rg_blame *blame);

// Runs both until they differ, first one frame, then twice as many, up to all. False, with one
// logged line, on failure, and without one on an interruption.
bool rg_blame_find(const struct rg_digest_run *run, struct rg_device *device,
                   struct rg_device *truth, struct rg_blame *blame);

// "blame" in docs/records.schema.json; the caller owns it.
json_t *rg_blame_json(const struct rg_blame *blame);

#endif
