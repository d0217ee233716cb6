#include "backends/cpu/cpu.h"

#include <stdlib.h>
#include <string.h>

#include "backends/formats.h"
#include "core/base/alloc.h"
#include "core/base/log.h"

struct rg_image *cpu_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                  const char *name)
{
    uint32_t header[RG_MAX_LEVELS];
    int64_t words = rg_image_layout(desc, header);
    struct cpu_image *image = rg_alloc(1, sizeof(*image), name);
    if (!image)
        return NULL;
    image->shape = (rg_image_shape){desc->width, desc->height, desc->layers, desc->levels};
    image->words = (int)words;
    image->texels = rg_alloc_lines((size_t)words * sizeof(uint));
    if (!image->texels) {
        free(image);
        return rg_harness_error_null("image '%s': %s has no %lld bytes of memory left", name,
                                     device->info.name, (long long)words * 4);
    }
    memcpy(image->texels, header, sizeof(header));
    return &image->pub;
}

void cpu_image_destroy(struct rg_image *image)
{
    struct cpu_image *cpu = (struct cpu_image *)image;
    free(cpu->texels);
    free(cpu);
}

// The address of a layer of a level, and its size in bytes.
static void *locate(struct rg_image *image, int layer, int level, size_t *size)
{
    struct cpu_image *cpu = (struct cpu_image *)image;
    return (char *)cpu->texels + rg_image_locate(&image->desc, cpu->texels, layer, level, size);
}

bool cpu_image_write(struct rg_image *image, int layer, int level, const void *texels)
{
    size_t size;
    void *to = locate(image, layer, level, &size);
    memcpy(to, texels, size);
    return true;
}

bool cpu_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    size_t size;
    const void *from = locate(image, layer, level, &size);
    memcpy(texels, from, size);
    return true;
}

// Texels in a step of clearing, copied by one thread from a pattern that stays in its cache.
enum { CLEAR_TEXELS = 1024, MAX_TEXEL_WORDS = 4 };

bool cpu_image_clear(struct rg_image *image, const void *texel)
{
    struct cpu_image *cpu = (struct cpu_image *)image;
    const size_t texel_size = (size_t)rg_format_size(image->desc.format);
    const size_t total = ((size_t)cpu->words - RG_MAX_LEVELS) * sizeof(uint);
    uint pattern[CLEAR_TEXELS * MAX_TEXEL_WORDS];
    const size_t step = CLEAR_TEXELS * texel_size;
    for (size_t at = 0; at < step; at += texel_size)
        memcpy((char *)pattern + at, texel, texel_size);
    char *first = (char *)(cpu->texels + RG_MAX_LEVELS);
    const int64_t steps = (int64_t)((total + step - 1) / step); // NOLINT: a texel has bytes
#pragma omp parallel for schedule(static) if (steps > 64)
    for (int64_t i = 0; i < steps; i++) {
        const size_t at = (size_t)i * step;
        memcpy(first + at, pattern, total - at < step ? total - at : step);
    }
    return true;
}
