// The image that a row's cells must show; a cell that shows another is not timed.
#ifndef RG_HARNESS_DEVICES_MEASURE_EXPECTED_H
#define RG_HARNESS_DEVICES_MEASURE_EXPECTED_H

#include "harness/devices/frames/session.h"

enum { RG_CHECK_FRAMES = 10 }; // frames before images are compared, by default

// The image of cpu:reference after a table's check frames. Zeroed: none.
struct rg_expected {
    struct rg_device_info device; // cpu:reference's
    void *texels;                 // in the target's format, `size` bytes; owned
    size_t size;
    struct rg_picture picture; // the same texels as a picture
    struct rg_picture dry;     // without rain: the background for the rain mask; empty: unused
};

// Reads a session's current image. False, and one logged line, on failure. The caller calls
// rg_expected_free in either case.
bool rg_expected_read(struct rg_expected *expected, struct rg_session *session);
// Whether the image differs from the background anywhere. False, and one logged line, when memory
// runs out.
bool rg_expected_shows_rain(const struct rg_expected *expected, bool *shows);
void rg_expected_free(struct rg_expected *expected);

#endif
