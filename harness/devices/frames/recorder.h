// Records digests of a run in this process. Only files of this folder include it; others use
// digests.h.
#ifndef RG_HARNESS_DEVICES_FRAMES_RECORDER_H
#define RG_HARNESS_DEVICES_FRAMES_RECORDER_H

#include "harness/devices/frames/digests.h"

// As rg_digests_take, rg_digests_contents and rg_digests_dispatches; results must be zeroed before.
bool rg_recorder_take(const struct rg_digest_run *run, struct rg_device *device,
                      struct rg_digests *digests);
bool rg_recorder_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                          struct rg_contents *contents, struct rg_state *state);

bool rg_recorder_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                            int stages_run, struct rg_dispatches *dispatches);
// As rg_digests_code, in this process for any device.
void *rg_recorder_code(struct rg_device *device, const struct rg_kernel *kernel,
                       enum rg_code_kind kind, size_t *size);

#endif
