#include "backends/formats.h"

#include <limits.h>
#include <string.h>

static const struct {
    const char *name;
    int size;
} formats[RG_FORMAT_COUNT] = {
    [RG_FORMAT_NONE] = {"none", 0},  [RG_RGBA8] = {"RGBA8", 4}, [RG_RGBA16F] = {"RGBA16F", 8},
    [RG_RGBA32F] = {"RGBA32F", 16},  [RG_R32F] = {"R32F", 4},   [RG_R16F] = {"R16F", 2},
    [RG_RG11B10F] = {"RG11B10F", 4}, [RG_D32F] = {"D32F", 4},
};

int rg_format_size(enum rg_format format)
{
    return formats[format].size;
}

const char *rg_format_name(enum rg_format format)
{
    return formats[format].name;
}

int rg_level_size(int size, int level)
{
    return size >> level > 1 ? size >> level : 1;
}

int64_t rg_image_layout(const struct rg_image_desc *desc, uint32_t header[RG_MAX_LEVELS])
{
    int64_t words = RG_MAX_LEVELS;
    memset(header, 0, RG_MAX_LEVELS * sizeof(*header));
    for (int level = 0; level < desc->levels; level++) {
        header[level] = (uint32_t)words;
        const int64_t texels = (int64_t)rg_level_size(desc->width, level) *
                               rg_level_size(desc->height, level) * desc->layers;
        words += (texels * rg_format_size(desc->format) + 3) / 4;
    }
    return rg_format_size(desc->format) < 4 ? words + 1 : words; // two texels are read at once
}

void rg_plain_formats(struct rg_format_limits limits[RG_FORMAT_COUNT], int64_t max_bytes)
{
    for (int f = RG_FORMAT_NONE + 1; f < RG_FORMAT_COUNT; f++) {
        // Texels of half a word are counted in half words, so that an int addresses half as many
        // bytes.
        const int64_t countable = (int64_t)(formats[f].size < 4 ? INT_MAX / 2 : INT_MAX) * 4;
        limits[f] =
            (struct rg_format_limits){RG_USE_ALL, RG_PLAIN_MAX_PX, RG_PLAIN_MAX_LAYERS,
                                      RG_MAX_LEVELS, countable < max_bytes ? countable : max_bytes};
    }
}

size_t rg_image_locate(const struct rg_image_desc *desc, const uint32_t header[RG_MAX_LEVELS],
                       int layer, int level, size_t *size)
{
    *size = (size_t)rg_level_size(desc->width, level) * (size_t)rg_level_size(desc->height, level) *
            (size_t)rg_format_size(desc->format);
    return header[level] * sizeof(*header) + (size_t)layer * *size;
}
