// What each stage of a run left in each asset, as digests: equal runs have equal ones, so that two
// of them tell which stage differed first.
#ifndef RG_HARNESS_FRAMES_DIGESTS_H
#define RG_HARNESS_FRAMES_DIGESTS_H

#include "core/techniques/stages/dispatched.h"
#include "harness/frames/subject.h"

// So many frames of a subject, each simulated and drawn.
struct rg_digest_run {
    struct rg_subject subject;
    int frames;
};

// One asset after one stage. An asset has a digest after each stage that wrote it, and after any
// other behind which it was found to have changed.
struct rg_digest {
    int64_t frame;  // that is being simulated or drawn
    int stages_run; // since the instance was opened, this one included
    char stage[RG_ASSET_NAME], asset[RG_ASSET_NAME];
    uint64_t hash;
    int64_t weight; // of the run until then: items of its stages, and words of its assets
};

// Zeroed: none.
struct rg_digests {
    int count;
    int64_t room;
    struct rg_digest *rows; // owned
};

// Runs and records; frames are left out once raingauge is interrupted. The caller frees them.
// False, with one logged line and no digests, on failure.
bool rg_digests_take(const struct rg_digest_run *run, struct rg_device *device,
                     struct rg_digests *digests);
void rg_digests_free(struct rg_digests *digests);

// Runs once more, and brings what the asset of a row held then, with what is known of it as a state
// (`state`: its name is NULL where it is none) and of a buffer's words. False, and one logged line,
// on failure; the contents are to be freed in either case.
bool rg_digests_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                         struct rg_contents *contents, struct rg_state *state);

// Runs once more, up to the stage before which so many have run, one less than its number, and
// keeps each dispatch from the end of the stage before it to its own end. False, and one logged
// line, on failure; to be freed in either case.
bool rg_digests_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                           int stages_run, struct rg_dispatches *dispatches);
// Runs one of them on a device (rg_dispatched_run).
bool rg_digests_dispatch(struct rg_dispatched *dispatched, struct rg_device *device);

// The code that a device gives its driver for a kernel, or would if its API took this kind: bytes
// that the caller frees. NULL, and one logged line, on failure.
void *rg_digests_code(struct rg_device *device, const struct rg_kernel *kernel,
                      enum rg_code_kind kind, size_t *size);

// Has a device compile a kernel, and drops it. False, and one logged line, on failure.
bool rg_digests_compile(struct rg_device *device, const struct rg_kernel *kernel);

#endif
