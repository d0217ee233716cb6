// Chunks of a PNG other than its rows: the curve and colours of its codes, its place and
// orientation, frames of an animation. libpng (1.6) knows neither cICP nor animations, and treats a
// damaged profile as none, so these chunks are parsed here.
#ifndef RG_CORE_IMAGE_FILES_PNG_BESIDE_H
#define RG_CORE_IMAGE_FILES_PNG_BESIDE_H

#include <png.h>
#include <stdbool.h>
#include <stdint.h>
#include <xxhash.h>

#include "core/image/picture.h"

enum rg_png_chunk {
    RG_PNG_GAMA,
    RG_PNG_CHRM,
    RG_PNG_SRGB,
    RG_PNG_ICCP,
    RG_PNG_CICP,
    RG_PNG_PHYS,
    RG_PNG_OFFS,
    RG_PNG_EXIF,
    RG_PNG_CHUNKS
};

// Zero it at first; rg_png_beside_release frees it.
struct rg_png_beside {
    struct {
        bool is_there;
        uint32_t size;
        uint8_t bytes[512];  // the first ones
    } chunks[RG_PNG_CHUNKS]; // the first of each kind before the rows
    uint64_t profile;        // a digest of the profile
    uint32_t profile_bytes;
    XXH3_state_t *animation;
    int frames; // frames of the animation; 0: none
};

// Makes libpng hand over the chunks; call it before anything is read.
void rg_png_beside_collect(struct rg_png_beside *beside, png_structp png);

// Sets the picture's gamma and adds its extras. False when memory for them runs out.
bool rg_png_beside_tell(const struct rg_png_beside *beside, struct rg_picture *picture);
void rg_png_beside_release(struct rg_png_beside *beside);

#endif
