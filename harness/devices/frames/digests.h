// Digests of the assets after each stage of a run. Equal runs have equal digests, so that two runs
// show which stage differed first.
#ifndef RG_HARNESS_DEVICES_FRAMES_DIGESTS_H
#define RG_HARNESS_DEVICES_FRAMES_DIGESTS_H

#include "core/techniques/stages/dispatched.h"
#include "harness/devices/frames/subject.h"

// A run: this many frames of a subject, each simulated and drawn.
struct rg_digest_run {
    struct rg_subject subject;
    int frames;
};

// The digest of one asset after one stage. An asset gets one after each stage that wrote it, and
// after any other stage that changed it.
struct rg_digest {
    int64_t frame;  // the frame being simulated or drawn
    int stages_run; // since the instance was opened, including this one
    char stage[RG_ASSET_NAME], asset[RG_ASSET_NAME];
    uint64_t hash;
    int64_t weight; // work of the run so far: items of its stages, and words of its assets
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

// Runs once more, and returns what the asset of a row held then. `state` describes a buffer's
// words; its name is NULL unless the asset is a state. False, and one logged line, on failure; the
// caller frees the contents in either case.
bool rg_digests_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                         struct rg_contents *contents, struct rg_state *state);

// Runs again, up to the stage after which `stages_run` stages have run, and records each dispatch
// of it: all after the end of the stage before. False, and one logged line, on failure; the caller
// frees the dispatches in either case.
bool rg_digests_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                           int stages_run, struct rg_dispatches *dispatches);
// Replays one dispatch on a device (rg_dispatched_run).
bool rg_digests_dispatch(struct rg_dispatched *dispatched, struct rg_device *device);

// The code of a kernel that a device gives to its driver, or would give if its API took this kind
// of code: bytes that the caller frees. NULL, and one logged line, on failure.
void *rg_digests_code(struct rg_device *device, const struct rg_kernel *kernel,
                      enum rg_code_kind kind, size_t *size);

// Makes a device compile a kernel, which is dropped. False, and one logged line, on failure.
bool rg_digests_compile(struct rg_device *device, const struct rg_kernel *kernel);

#endif
