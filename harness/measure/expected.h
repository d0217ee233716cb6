// The image that the cells of a row must show: a cell that shows another is not timed.
#ifndef RG_HARNESS_MEASURE_EXPECTED_H
#define RG_HARNESS_MEASURE_EXPECTED_H

#include "harness/frames/session.h"

enum { RG_CHECK_FRAMES = 10 }; // simulated before the image is compared, where a table does not say

// The image of cpu:reference after a table's check frames. Zeroed: none.
struct rg_expected {
    struct rg_device_info device; // cpu:reference's
    void *texels;                 // as the target holds them, `size` bytes; owned
    size_t size;
    struct rg_picture picture; // the same
    struct rg_picture dry;     // without rain: the background of the rain mask; empty: not wanted
};

// Reads what a session shows now. False, and one logged line, on failure. The caller calls
// rg_expected_free in either case.
bool rg_expected_read(struct rg_expected *expected, struct rg_session *session);
// Whether it differs from the background anywhere. False, and one logged line, without memory.
bool rg_expected_shows_rain(const struct rg_expected *expected, bool *shows);
void rg_expected_free(struct rg_expected *expected);

#endif
