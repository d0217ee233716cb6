#include "harness/frame.h"

#include <stdlib.h>

#include "core/log.h"
#include "core/techniques/proof.h"
#include "kernels/format.h"

struct rg_instance *rg_frame_run(const struct rg_technique *technique, const void *settings,
                                 struct rg_device *device, int width, int height, int frames)
{
    struct rg_instance *instance = technique->create(device, settings, width, height);
    bool ok = instance != NULL;
    for (int i = 0; ok && i < frames; i++)
        ok = technique->step(instance);
    if (ok && technique->draw(instance) && rg_device_sync(device))
        return instance;
    if (instance)
        technique->destroy(instance);
    return NULL;
}

void *rg_frame_read(struct rg_instance *instance, size_t *size)
{
    const struct rg_image_desc *desc = &instance->target->desc;
    *size = (size_t)desc->width * (size_t)desc->height * (size_t)rg_format_size(desc->format);
    void *texels = malloc(*size);
    if (!texels)
        return rg_error_null("image '%s': no memory for %zu bytes", instance->target->name, *size);
    if (rg_image_read(instance->target, 0, 0, texels))
        return texels;
    free(texels);
    return NULL;
}

bool rg_frame_picture(const struct rg_instance *instance, const void *texels,
                      struct rg_picture *picture)
{
    const struct rg_image_desc *desc = &instance->target->desc;
    const uint16_t *halves = texels;
    if (!rg_picture_create(picture, desc->width, desc->height, 4, "image"))
        return false;
    for (int64_t i = 0; i < rg_picture_values(picture); i++)
        picture->texels[i] = rg_unpack_half(halves[i]);
    return true;
}

bool rg_frame_read_picture(struct rg_instance *instance, struct rg_picture *picture)
{
    size_t size;
    void *texels = rg_frame_read(instance, &size);
    const bool ok = texels && rg_frame_picture(instance, texels, picture);
    free(texels);
    return ok;
}

bool rg_frame_draw(const struct rg_technique *technique, const void *settings,
                   struct rg_device *device, int width, int height, int frames,
                   struct rg_picture *picture)
{
    struct rg_instance *instance = rg_frame_run(technique, settings, device, width, height, frames);
    if (!instance)
        return false;
    const bool ok = rg_frame_read_picture(instance, picture);
    technique->destroy(instance);
    return ok;
}

bool rg_frame_draw_dry(const struct rg_technique *technique, const void *settings,
                       struct rg_device *device, int width, int height, int frames,
                       struct rg_picture *picture)
{
    void *dry = rg_settings_copy(technique, settings, technique->proof->dry);
    const bool ok = dry && rg_frame_draw(technique, dry, device, width, height, frames, picture);
    free(dry);
    return ok;
}
