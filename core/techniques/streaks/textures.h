// The pictures of streaks and splashes on a device: the atlases of core/scene/atlas/atlas.h.
#ifndef RG_CORE_TECHNIQUES_STREAKS_TEXTURES_H
#define RG_CORE_TECHNIQUES_STREAKS_TEXTURES_H

#include "core/device/device.h"
#include "core/scene/atlas/atlas.h"

struct streaks_textures {
    struct rg_image *points, *skies, *crowns; // R16F; layers are oscillations, and splash frames
    struct rg_buf *factors;                   // floats, in the order of kernels/streaks/cells.h
    struct rg_buf *means;                     // floats; kernels/streaks/far/params.h
    int first_level;                          // the finest level of the full atlas that is present
    uint64_t hash;
};

// The textures of a size, shared on a device. NULL, and one logged line, on failure.
struct streaks_textures *streaks_textures_get(struct rg_device *device, enum rg_atlas_size size);
void streaks_textures_put(struct rg_device *device, struct streaks_textures *textures);

#endif
