#include "core/techniques/technique.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

struct rg_instance *rg_instance_open(const struct rg_technique *technique, struct rg_device *device,
                                     const void *settings, int width, int height)
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
