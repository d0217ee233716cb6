// Image formats in the host's own code, independent of kernels/dialect/image/format.h.
#ifndef RG_TESTS_CORE_DEVICE_IMAGES_TEXELS_H
#define RG_TESTS_CORE_DEVICE_IMAGES_TEXELS_H

#include <stddef.h>
#include <stdint.h>

#include "backends/kernel.h"

struct colour {
    float r, g, b, a;
};

// Fills `texels` with seeded texels of a format. Every number is finite, and normal as a 32-bit
// float or 0.
void random_texels(enum rg_format format, uint32_t seed, int count, void *texels);

// The colour that a kernel fetches of a packed texel.
struct colour decode_texel(enum rg_format format, const void *texel);

// The packed texel that a kernel's store of a colour leaves.
void encode_texel(enum rg_format format, struct colour colour, void *texel);

#endif
