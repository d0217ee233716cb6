// What the cells of a row must show, so that none is timed that does not.
#ifndef RG_HARNESS_EXPECTED_H
#define RG_HARNESS_EXPECTED_H

#include "core/image/picture.h"
#include "core/techniques/technique.h"

enum { RG_CHECK_FRAMES = 10 }; // simulated before the image is compared

// The image of cpu:reference after RG_CHECK_FRAMES frames. Zeroed: none.
struct rg_expected {
    void *texels; // as the target holds them, `size` bytes; owned
    size_t size;
    struct rg_picture picture; // the same
    struct rg_picture dry;     // without rain: the background of the rain mask
};

// Runs cpu:reference. `with_dry`: whether the background is wanted, which takes as long again.
// False, and one logged line, on failure. The caller calls rg_expected_free in either case.
bool rg_expected_make(struct rg_expected *expected, const struct rg_technique *technique,
                      const void *settings, int width, int height, bool with_dry);
void rg_expected_free(struct rg_expected *expected);

#endif
