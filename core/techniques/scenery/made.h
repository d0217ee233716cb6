// What instances of a device share of a scene (core/device/shared.h).
#ifndef RG_CORE_TECHNIQUES_SCENERY_MADE_H
#define RG_CORE_TECHNIQUES_SCENERY_MADE_H

#include "core/techniques/scenery/scenery.h"

struct streaks_scene_made {
    struct rg_device *device;
    struct city *city;
    struct rg_buf *faces, *surface_of, *surfaces, *openness;
    struct rg_image *textures;
    int levels; // of the textures
};

// NULL, and one logged line, on failure. streaks_scene_made_put before the device closes.
const struct streaks_scene_made *
streaks_scene_made_get(struct rg_device *device, const struct streaks_scene_settings *settings);
void streaks_scene_made_put(struct rg_device *device, const struct streaks_scene_made *made);

#endif
