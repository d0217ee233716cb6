// One run of a kernel as plain data: its parameters, items and what lay in its slots before and
// after, so that it can be run again, alone, on any device.
#ifndef RG_CORE_TECHNIQUES_STAGES_DISPATCHED_H
#define RG_CORE_TECHNIQUES_STAGES_DISPATCHED_H

#include "core/techniques/stages/contents.h"

// The owner calls rg_dispatched_free.
struct rg_dispatched {
    const struct rg_kernel *kernel;
    bool was_kept; // a DRAW program's is not: its slots are empty
    _Alignas(16) unsigned char params[RG_MAX_PARAMS_SIZE]; // kernels read them as structs
    struct rg_extent origin, extent;
    struct rg_contents before[RG_MAX_SLOTS]; // by slot
    struct rg_contents after[RG_MAX_SLOTS];  // likewise, of those that are written
};

// Zeroed: none. The owner calls rg_dispatches_free.
struct rg_dispatches {
    int count;
    int64_t room;
    struct rg_dispatched *rows; // owned, and what they own
};

// What a run of a pass has, before it runs and after. False, and one logged line, on failure.
bool rg_dispatched_before(const struct rg_pass *pass, const struct rg_run *run,
                          struct rg_dispatched *dispatched);
bool rg_dispatched_after(const struct rg_run *run, struct rg_dispatched *dispatched);

// Runs it on a device, from what lay in its slots before, and sets what lies there after, which is
// zeroed. False,
// and one logged line, on failure.
bool rg_dispatched_run(struct rg_dispatched *dispatched, struct rg_device *device);

void rg_dispatched_free(struct rg_dispatched *dispatched);
void rg_dispatches_free(struct rg_dispatches *dispatches);

#endif
