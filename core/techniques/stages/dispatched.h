// One run of a kernel as plain data: its parameters, its items, and the contents of its slots
// before and after, so that any device can replay it alone.
#ifndef RG_CORE_TECHNIQUES_STAGES_DISPATCHED_H
#define RG_CORE_TECHNIQUES_STAGES_DISPATCHED_H

#include "core/techniques/stages/contents.h"

// The owner calls rg_dispatched_free.
struct rg_dispatched {
    const struct rg_kernel *kernel;
    bool was_kept; // false for draws of packed primitives or counted samples: nothing is recorded
    // Aligned: kernels read structs. Of a draw: its rg_draw_state, then the parameters.
    _Alignas(16) unsigned char params[RG_MAX_PARAMS_SIZE];
    struct rg_extent origin, extent;
    bool has_colour, has_depth;              // of a draw: its targets, which are slots like others
    int layer, level;                        // of both
    struct rg_contents before[RG_MAX_SLOTS]; // by slot
    struct rg_contents after[RG_MAX_SLOTS];  // likewise, only of written slots; the last field
};

// The numbers of a draw's targets. A draw of items leaves these slots free.
enum { RG_SLOT_DEPTH = RG_SLOT_PRIMS, RG_SLOT_COLOUR = RG_SLOT_COUNTS };

// The slots of a recorded run: the kernel's, then a draw's targets. Returns their number.
int rg_dispatched_slots(const struct rg_dispatched *dispatched,
                        struct rg_slot_info slots[RG_MAX_SLOTS]);

// Zeroed: none. The owner calls rg_dispatches_free.
struct rg_dispatches {
    int count;
    int64_t room;
    struct rg_dispatched *rows; // owned, including what rows own
};

// Records a pass's run before and after it is made. False, and one logged line, on failure.
bool rg_dispatched_before(const struct rg_pass *pass, const struct rg_run *run,
                          struct rg_dispatched *dispatched);
bool rg_dispatched_after(const struct rg_run *run, struct rg_dispatched *dispatched);

// Replays a run on a device from the slots' contents before it, and sets those after it, which must
// be zeroed. False, and one logged line, on failure.
bool rg_dispatched_run(struct rg_dispatched *dispatched, struct rg_device *device);

void rg_dispatched_free(struct rg_dispatched *dispatched);
void rg_dispatches_free(struct rg_dispatches *dispatches);

#endif
