// A snapshot of a session on the host: its state, and its image.
#ifndef RG_HARNESS_COMPARE_VERIFY_SNAPSHOT_H
#define RG_HARNESS_COMPARE_VERIFY_SNAPSHOT_H

#include "harness/devices/frames/session.h"

struct rg_snapshot {
    int state_count;
    struct rg_state layout[RG_MAX_STATE]; // names and rows; `asset` is NULL
    void *state[RG_MAX_STATE];
    size_t state_bytes[RG_MAX_STATE];
    void *texels; // the target's, in the device's format; NULL: not read
    size_t texels_bytes;
};

// Reads the state, and the image if `with_image`. False, with one logged line and an empty
// snapshot, on failure. The caller calls rg_snapshot_free.
bool rg_snapshot_take(struct rg_session *session, bool with_image, struct rg_snapshot *snapshot);
// Also accepts a zeroed snapshot.
void rg_snapshot_free(struct rg_snapshot *snapshot);

bool rg_snapshot_same_state(const struct rg_snapshot *a, const struct rg_snapshot *b);
bool rg_snapshot_same_image(const struct rg_snapshot *a, const struct rg_snapshot *b);

// Names the first element of the state that differs, with both values: "water (17, 3) is 0.25
// (0x3e800000), not ..." (rg_contents_describe). "" when none does.
void rg_snapshot_describe(const struct rg_snapshot *a, const struct rg_snapshot *expected,
                          char *text, size_t size);

#endif
