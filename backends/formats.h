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
    RG_D32F, // depth target of DRAW passes; later passes can fetch it
    RG_FORMAT_COUNT
};

// The uses that a device allows for images of a format, as bits. Fetching is always allowed.
enum rg_format_use {
    RG_USE_FETCH = 1,
    RG_USE_STORE = 2, // kernels store to them
    RG_USE_DRAW = 4,
    RG_USE_BLEND = 8,
    RG_USE_ALL = 15,
    RG_USE_FILTER = 16, // the driver's samplers weigh texels, and it makes levels; native devices
                        // alone ask for it
};

// A device's limits for images of a format.
struct rg_format_limits {
    unsigned uses;                      // bits of enum rg_format_use; 0: no such images
    int max_px, max_layers, max_levels; // px: width and height
    int64_t max_bytes;                  // of all layers and levels, as rg_image_layout counts them
};

struct rg_image_desc {
    enum rg_format format;
    int width, height, layers;
    int levels; // 1 to RG_MAX_LEVELS; level l is max(1, width >> l) wide
};

// Bytes of a texel, 0 for RG_FORMAT_NONE; and the name as in kernels ("RGBA16F").
int rg_format_size(enum rg_format format);
const char *rg_format_name(enum rg_format format);
// The width or height of a level.
int rg_level_size(int size, int level);

// The layout of images in plain memory, used by cpu and opencl (kernels/dialect/image/memory.h). A
// header with the first word of each level, which is copied to `header`, precedes the levels.
// Returns the words of the whole image, header included.
int64_t rg_image_layout(const struct rg_image_desc *desc, uint32_t header[RG_MAX_LEVELS]);
// The limits of devices with such images: every format for all uses. Images have up to `max_bytes`,
// and as many texels as kernels can index by an int.
enum { RG_PLAIN_MAX_PX = 32768, RG_PLAIN_MAX_LAYERS = 2048 };
void rg_plain_formats(struct rg_format_limits limits[RG_FORMAT_COUNT], int64_t max_bytes);
// The offset of a layer of a level, and its size, both in bytes.
size_t rg_image_locate(const struct rg_image_desc *desc, const uint32_t header[RG_MAX_LEVELS],
                       int layer, int level, size_t *size);

#endif
