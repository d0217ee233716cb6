// How a device fails at a run that another one does: a difference between the two like any other,
// which can be blamed on a stage, shrunk and replayed.
#ifndef RG_HARNESS_COMPARE_BLAME_FALL_H
#define RG_HARNESS_COMPARE_BLAME_FALL_H

#include "core/base/outcome.h"
#include "harness/frames/digests.h"

enum { RG_FALL_SIZE = 600 };

// Zeroed: it does not fail.
struct rg_fall {
    enum rg_outcome outcome; // RG_OK, or an error, a crash or a timeout
    char what[RG_FALL_SIZE]; // a line that is the same whenever it fails so: "while running kernel
                             // 'flow_blur'", or the driver's error
};

// How a device failed whose last call just did, and whose process is renewed: the last error says
// nothing of what it will do next. RG_OK where it was no driver's failure.
struct rg_fall rg_fall_now(struct rg_device *device);
bool rg_fall_is_same(const struct rg_fall *a, const struct rg_fall *b);

// Of what another device left, the first row that a failure is about: that behind the stage whose
// kernel it names, or the last where it names none. -1: there is none.
int rg_fall_row(const struct rg_fall *fall, const struct rg_digests *digests);

#endif
