#include "core/techniques/stages/frame.h"

#include <stdlib.h>

#include "core/base/log.h"
#include "kernels/dialect/image/format.h"

void *rg_frame_read(struct rg_instance *instance, size_t *size)
{
    const struct rg_image_desc *desc = &instance->target->desc;
    *size = (size_t)desc->width * (size_t)desc->height * (size_t)rg_format_size(desc->format);
    void *texels = malloc(*size);
    if (!texels)
        return rg_harness_error_null("image '%s': no memory for %zu bytes", instance->target->name,
                                     *size);
    if (rg_image_read(instance->target, 0, 0, texels))
        return texels;
    free(texels);
    return NULL;
}

bool rg_frame_picture(const void *texels, int width, int height, struct rg_picture *picture)
{
    const uint16_t *halves = texels;
    if (!rg_picture_create(picture, width, height, 4, "image"))
        return false;
    for (int64_t i = 0; i < rg_picture_values(picture); i++)
        picture->texels[i] = rg_unpack_half(halves[i]);
    return true;
}

bool rg_frame_read_picture(struct rg_instance *instance, struct rg_picture *picture)
{
    const struct rg_image_desc *desc = &instance->target->desc;
    size_t size;
    void *texels = rg_frame_read(instance, &size);
    const bool ok = texels && rg_frame_picture(texels, desc->width, desc->height, picture);
    free(texels);
    return ok;
}
