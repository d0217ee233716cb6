#include "backends/opencl/opencl.h"

#include <stdlib.h>
#include <string.h>

#include "backends/formats.h"
#include "core/base/alloc.h"

struct rg_image *opencl_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                     const char *name)
{
    uint32_t header[RG_MAX_LEVELS];
    int64_t bytes = rg_image_layout(desc, header) * (int64_t)sizeof(cl_uint);
    struct opencl_image *image = rg_alloc(1, sizeof(*image), name);
    if (!image)
        return NULL;
    image->shape = (rg_image_shape){desc->width, desc->height, desc->layers, desc->levels};
    memcpy(image->header, header, sizeof(header));
    image->words = (int)(bytes / 4);
    image->memory = (struct opencl_memory){NULL, (struct opencl_device *)device, "image", name};
    if (!opencl_memory_create(&image->memory, (size_t)bytes)) {
        free(image);
        return NULL;
    }
    if (opencl_memory_write(&image->memory, 0, image->header, sizeof(image->header)))
        return &image->pub;
    opencl_image_destroy(&image->pub);
    return NULL;
}

void opencl_image_destroy(struct rg_image *image)
{
    clReleaseMemObject(((struct opencl_image *)image)->memory.mem);
    free(image);
}

// The offset of a layer of a level, and its size, both in bytes.
static size_t locate(const struct rg_image *image, int layer, int level, size_t *size)
{
    const struct opencl_image *opencl = (const struct opencl_image *)image;
    return rg_image_locate(&image->desc, opencl->header, layer, level, size);
}

int opencl_image_word(const struct rg_image *image, int layer, int level)
{
    size_t size;
    return (int)(locate(image, layer, level, &size) / sizeof(cl_uint));
}

bool opencl_image_write(struct rg_image *image, int layer, int level, const void *texels)
{
    size_t size, offset = locate(image, layer, level, &size);
    return opencl_memory_write(&((struct opencl_image *)image)->memory, offset, texels, size);
}

bool opencl_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    size_t size, offset = locate(image, layer, level, &size);
    return opencl_memory_read(&((struct opencl_image *)image)->memory, offset, texels, size);
}

bool opencl_image_clear(struct rg_image *image, const void *texel)
{
    struct opencl_image *opencl = (struct opencl_image *)image;
    struct opencl_device *device = opencl->memory.device;
    if (!opencl_will_queue(device))
        return false;
    cl_int code = clEnqueueFillBuffer(
        device->queue, opencl->memory.mem, texel, (size_t)rg_format_size(image->desc.format),
        sizeof(opencl->header), (size_t)opencl->words * sizeof(cl_uint) - sizeof(opencl->header), 0,
        NULL, NULL);
    return opencl_check(code, "clEnqueueFillBuffer", "image", image->name);
}
