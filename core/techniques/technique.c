#include "core/techniques/technique.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/device/work.h"

// Opens an instance; objects are made or only counted, as the device's room says.
static struct rg_instance *open_instance(const struct rg_technique *technique,
                                         struct rg_device *device, const void *settings, int width,
                                         int height)
{
    struct rg_instance *instance = rg_alloc(1, technique->size, technique->name);
    if (!instance)
        return NULL;
    instance->technique = technique;
    instance->device = device;
    memcpy((char *)instance + technique->settings, settings, technique->params->settings_size);
    const struct rg_asset *target = rg_add_image(instance, "target", RG_RGBA16F, width, height);
    instance->target = target ? target->image : NULL;
    if (target && technique->open(instance) && !instance->has_failed)
        return instance;
    rg_instance_close(instance);
    return NULL;
}

// Counts the memory of the first frame of an instance whose objects are only counted, and closes
// it. Returns the bytes.
static int64_t count_frame(const struct rg_technique *technique, struct rg_device *device,
                           struct rg_instance *instance)
{
    bool is_taken;
    if (instance && technique->step(instance))
        technique->draw(instance);
    rg_instance_close(instance);
    return rg_room_end(device, &is_taken);
}

int64_t rg_instance_bytes(const struct rg_technique *technique, struct rg_device *device,
                          const void *settings, int width, int height)
{
    rg_room_begin(device, RG_ROOM_COUNTED);
    return count_frame(technique, device,
                       open_instance(technique, device, settings, width, height));
}

static bool is_allowed(const struct rg_technique *technique, const struct rg_device *device,
                       int width, int height, int64_t bytes)
{
    char begin[160];
    snprintf(begin, sizeof(begin), "%s of %dx%d on %.60s", technique->name, width, height,
             device->info.name);
    return rg_memory_allows(bytes) || rg_memory_refuse(begin, bytes, "a smaller --size or setting");
}

struct rg_instance *rg_instance_open(const struct rg_technique *technique, struct rg_device *device,
                                     const void *settings, int width, int height)
{
    bool is_taken;
    rg_room_begin(device, RG_ROOM_WATCHED);
    struct rg_instance *instance = open_instance(technique, device, settings, width, height);
    if (device->work->room != RG_ROOM_COUNTED) {
        rg_room_end(device, &is_taken);
        return instance;
    }
    const int64_t bytes = count_frame(technique, device, instance);
    return is_allowed(technique, device, width, height, bytes)
               ? open_instance(technique, device, settings, width, height)
               : NULL;
}

void rg_instance_close(struct rg_instance *instance)
{
    if (!instance)
        return;
    if (instance->technique->close)
        instance->technique->close(instance);
    rg_stages_free(instance);
    rg_assets_free(instance);
    free(instance);
}

void *rg_settings_create(const struct rg_technique *technique)
{
    void *settings = rg_alloc(1, technique->params->settings_size, technique->name);
    if (settings)
        rg_params_reset(technique->params, settings);
    return settings;
}

void *rg_settings_copy(const struct rg_technique *technique, const void *settings,
                       const char *assignments)
{
    char *copy = rg_alloc(1, technique->params->settings_size, technique->name);
    if (copy)
        memcpy(copy, settings, technique->params->settings_size);
    const bool ok = copy && rg_params_set_all(technique->params, copy, assignments);
    if (ok)
        return copy;
    free(copy);
    return NULL;
}
