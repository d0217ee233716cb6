// Which of the atlas' crowns a splash makes: that of the surface it hits. Programs and kernels
// that include it behind their slots have those of particle.h and
//   IMAGE(10, RGBA8, numbers)  the numbers of the surfaces seen along the fall, r lowest, with the
//                              extent of the depth map; or one texel: all splashes are of one kind
//   IN(11, uint, surfaces)     SCENERY_SURFACE_WORDS each
#ifndef RG_KERNELS_STREAKS_MATERIAL_H
#define RG_KERNELS_STREAKS_MATERIAL_H

#include "kernels/streaks/particle.h"
#include "kernels/scenery/surface.h"

// The atlas' materials (core/scene/atlas/atlas.h).
#define STREAKS_FILM   0u // a thin film of water; 0, so that what is not known has one
#define STREAKS_PUDDLE 1u
#define STREAKS_ROUGH  2u // dry asphalt, and all that is rough and holds no water
#define STREAKS_SMOOTH 3u // metal or glass

// A kind's material, two bits each: streets are wet in the rain, and water stands on flat roofs.
#define STREAKS_MATERIALS                                                                          \
    ((STREAKS_ROUGH << (2 * SCENERY_KIND_WALL)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_GLASS)) |   \
     (STREAKS_PUDDLE << (2 * SCENERY_KIND_ROOF)) | (STREAKS_FILM << (2 * SCENERY_KIND_ASPHALT)) |  \
     (STREAKS_FILM << (2 * SCENERY_KIND_PAVING)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_METAL)) |  \
     (STREAKS_ROUGH << (2 * SCENERY_KIND_EARTH)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_LEAVES)) | \
     (STREAKS_PUDDLE << (2 * SCENERY_KIND_WATER)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_LIGHT)))

// 0 to 3. The ground plane, where nothing else is hit, has a film as streets have.
RG_FN int streaks_material(rg_ctx rg, streaks_params p, streaks_particle t)
{
    streaks_map_place at =
        streaks_map_place_at(p, t.x, t.y, numbers_width(rg, 0), numbers_height(rg, 0));
    uint number = numbers_bytes(rg, at.x, at.y, 0, 0);
    int known = (1 - at.outside) * (number != SCENERY_NO_SURFACE ? 1 : 0);
    uint look = surfaces_at(rg, rg_to_int(number * rg_to_uint(known)) * SCENERY_SURFACE_WORDS +
                                    SCENERY_LOOK);
    return known * rg_to_int((STREAKS_MATERIALS >> (2u * scenery_kind(look))) & 3u);
}

#endif
