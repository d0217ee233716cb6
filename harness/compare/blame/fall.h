// How a device fails a run that another one completes: a kind of difference, which can be blamed on
// a stage, shrunk and replayed.
#ifndef RG_HARNESS_COMPARE_BLAME_FALL_H
#define RG_HARNESS_COMPARE_BLAME_FALL_H

#include "core/base/outcome.h"
#include "harness/devices/frames/digests.h"

enum { RG_FALL_SIZE = 600 };

// Zeroed: no failure.
struct rg_fall {
    enum rg_outcome outcome; // RG_OK, or an error, a crash or a timeout
    char what[RG_FALL_SIZE]; // the same line at each such failure: "while running kernel
                             // 'flow_blur'", or the driver's error
};

// Describes the failure of a device's last call, and renews its process, so that the next call
// starts afresh. RG_OK if the failure was not the driver's.
struct rg_fall rg_fall_now(struct rg_device *device);
bool rg_fall_is_same(const struct rg_fall *a, const struct rg_fall *b);

// The row of the other device's digests that a failure is about: after the stage whose kernel it
// names, or the last one. -1: none.
int rg_fall_row(const struct rg_fall *fall, const struct rg_digests *digests);

#endif
