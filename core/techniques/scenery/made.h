// The parts of a scene that instances of a device share (core/device/shared.h).
#ifndef RG_CORE_TECHNIQUES_SCENERY_MADE_H
#define RG_CORE_TECHNIQUES_SCENERY_MADE_H

#include "core/device/device.h"
#include "core/techniques/scenery/settings.h"

struct scenery_made {
    struct rg_device *device;
    struct city *city;
    struct rg_buf *faces, *surface_of, *surfaces;
};

// Further parts, which only the light of a scene needs: all of its textures, and the openness of
// all places.
struct scenery_paint {
    struct rg_device *device;
    struct rg_buf *openness;
    struct rg_image *textures;
    int levels; // of the textures
};

// Gets the shared parts; NULL, and one logged line, on failure. Call scenery_made_put before the
// device closes.
const struct scenery_made *scenery_made_get(struct rg_device *device,
                                            const struct scenery_settings *settings);
void scenery_made_put(struct rg_device *device, const struct scenery_made *made);

// The same for the parts that the light of `made` needs; `settings` are those of `made`.
const struct scenery_paint *scenery_paint_get(const struct scenery_made *made,
                                              const struct scenery_settings *settings);
void scenery_paint_put(struct rg_device *device, const struct scenery_paint *paint);

#endif
