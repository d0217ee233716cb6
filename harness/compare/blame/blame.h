// Where two devices part: the first stage that leaves other bits in an asset than it does on the
// other device, which is held for the truth, the place, and the kind of difference.
#ifndef RG_HARNESS_COMPARE_BLAME_BLAME_H
#define RG_HARNESS_COMPARE_BLAME_BLAME_H

#include <jansson.h>

#include "harness/compare/blame/difference.h"
#include "harness/frames/digests.h"

// Zeroed: nothing differs.
struct rg_blame {
    bool found;
    bool is_alone;          // one of the two alone writes the asset, or the stages are not the same
    struct rg_digest first; // on the device; its stage is "" where opening has left other bits
    uint64_t expected;      // the hash on the other one; as all below not known where it is alone
    enum rg_difference difference;
    bool is_image;
    int64_t item;             // of a buffer: which element
    int x, y;                 // of an image: which texel
    int layer, level;         // likewise
    int64_t differing, words; // of 4 bytes
    char text[600];           // a line: "frame 1, stage flow_normals: normals[17] is 0.5, ..."
};

// The first row in which two runs differ; -1: none.
int rg_blame_first(const struct rg_digests *digests, const struct rg_digests *expected);

// Says what a row is about in which two runs differ, from more runs of both. False, with one logged
// line, where they fail; the line has as much as is known.
bool rg_blame_row(const struct rg_digest_run *run, struct rg_device *device,
                  struct rg_device *truth, const struct rg_digests *digests,
                  const struct rg_digests *expected, struct rg_blame *blame);

// Runs both until they differ, for one frame, then twice as many, up to all. False, with one logged
// line, on failure, and without one where raingauge is interrupted.
bool rg_blame_find(const struct rg_digest_run *run, struct rg_device *device,
                   struct rg_device *truth, struct rg_blame *blame);

// The same for machines (docs/records.md); the caller owns it.
json_t *rg_blame_json(const struct rg_blame *blame);

#endif
