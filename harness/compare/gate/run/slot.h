// One time of a cell, in whatever order a gate takes several, and whether others took the machine's
// time meanwhile.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_SLOT_H
#define RG_HARNESS_COMPARE_GATE_RUN_SLOT_H

#include "harness/frames/session.h"

enum { RG_SLOT_FRAMES = 1000, RG_SLOT_TIMINGS = 9 }; // at most

// What a slot is made of: so many timings, of so many frames each. Zeroed: not settled yet.
struct rg_slot {
    int frames, timings;
};

// Of all processors together since the machine began; zeros where the kernel does not tell.
struct rg_processor_time {
    unsigned long long all, stolen;
};
struct rg_processor_time rg_processor_time(void);
// Whether so much went to others since then that what was timed does not count.
bool rg_was_disturbed(const struct rg_processor_time *before);

// Frames that do not count, for drivers compile in the first; tells about how long one takes.
// False, and one logged line, on failure, here and below.
bool rg_slot_warm_up(struct rg_session *session, double *frame_ms);
// Settles it for frames of such a time.
void rg_slot_settle(struct rg_slot *slot, double frame_ms);
// The time of a frame, by the median of the slot's timings.
bool rg_slot_time(struct rg_session *session, const struct rg_slot *slot, double *frame_ms);

#endif
