// What streaks and splashes look like, on a device: the atlases of core/scene/atlas/atlas.h.
#ifndef RG_CORE_TECHNIQUES_STREAKS_TEXTURES_H
#define RG_CORE_TECHNIQUES_STREAKS_TEXTURES_H

#include "core/device/device.h"
#include "core/scene/atlas/atlas.h"

struct streaks_textures {
    struct rg_image *points, *skies, *crowns; // R16F: layers are oscillations, and splash frames
    struct rg_buf *factors;                   // floats; kernels/streaks/cells.h says in what order
    struct rg_buf *means;                     // floats; kernels/streaks/far/params.h
    int first_level;                          // the first of the full atlas' levels that is there
    uint64_t hash;
};

// The textures of a size, shared by all who ask for them on a device. NULL, and one logged line, on
// failure.
struct streaks_textures *streaks_textures_get(struct rg_device *device, enum rg_atlas_size size);
void streaks_textures_put(struct rg_device *device, struct streaks_textures *textures);

#endif
