// Formats of images, and how images lie in plain memory.
#ifndef RG_BACKENDS_FORMATS_H
#define RG_BACKENDS_FORMATS_H

#include <stddef.h>
#include <stdint.h>

#include "kernels/dialect/limits.h"

enum rg_format {
    RG_FORMAT_NONE,
    RG_RGBA8,
    RG_RGBA16F,
    RG_RGBA32F,
    RG_R32F,
    RG_R16F,
    RG_RG11B10F,
    RG_D32F, // depth of a DRAW pass's target; fetched by later passes
    RG_FORMAT_COUNT
};

// What a device can do with images of a format, a bit each. It fetches from images of every format
// that it has.
enum rg_format_use {
    RG_USE_FETCH = 1,
    RG_USE_STORE = 2, // kernels store to them
    RG_USE_DRAW = 4,
    RG_USE_BLEND = 8,
    RG_USE_ALL = 15,
};

// What a device allows an image of a format.
struct rg_format_limits {
    unsigned uses;                      // enum rg_format_use; 0: it has no such images
    int max_px, max_layers, max_levels; // px: width and height
    int64_t max_bytes;                  // of all layers and levels as rg_image_layout counts them
};

struct rg_image_desc {
    enum rg_format format;
    int width, height, layers;
    int levels; // 1 to RG_MAX_LEVELS; level l is max(1, width >> l) wide
};

// Bytes a texel; 0 for RG_FORMAT_NONE. Name as in kernels ("RGBA16F").
int rg_format_size(enum rg_format format);
const char *rg_format_name(enum rg_format format);
// Width or height of a level.
int rg_level_size(int size, int level);

// How cpu and opencl, which keep images in plain memory, lay them out
// (kernels/dialect/image/memory.h): first a header, the word at which each level begins, which
// `header` gets; then the levels. Returns the words of the whole image, header included.
int64_t rg_image_layout(const struct rg_image_desc *desc, uint32_t header[RG_MAX_LEVELS]);
// What such a device allows: images of every format for all uses, of at most `max_bytes`, whose
// texels kernels can count in an int.
enum { RG_PLAIN_MAX_PX = 32768, RG_PLAIN_MAX_LAYERS = 2048 };
void rg_plain_formats(struct rg_format_limits limits[RG_FORMAT_COUNT], int64_t max_bytes);
// Where a layer of a level begins in it, and its size, both in bytes.
size_t rg_image_locate(const struct rg_image_desc *desc, const uint32_t header[RG_MAX_LEVELS],
                       int layer, int level, size_t *size);

#endif
