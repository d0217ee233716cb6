// The surface that a drop hits: the crown of the atlas that its splash makes, and the splash's
// upward direction. Programs and kernels include this file after their slots, which have those of
// particle.h and
//   IMAGE(10, RGBA8, numbers)  the numbers of the surfaces seen along the fall, r lowest, with the
//                              extent of the depth map; or one texel: all splashes are of one kind
//   IN(11, uint, surfaces)     SCENERY_SURFACE_WORDS each
#ifndef RG_KERNELS_STREAKS_MATERIAL_H
#define RG_KERNELS_STREAKS_MATERIAL_H

#include "kernels/streaks/particle.h"
#include "kernels/scenery/surface.h"

// The atlas' materials (core/scene/atlas/atlas.h).
#define STREAKS_FILM   0u // a thin film of water; 0, so that unknown surfaces have one
#define STREAKS_PUDDLE 1u
#define STREAKS_ROUGH  2u // dry asphalt, and other rough surfaces that hold no water
#define STREAKS_SMOOTH 3u // metal or glass

// A kind's material, two bits each: streets are wet in the rain, and water stands on flat roofs.
#define STREAKS_MATERIALS                                                                          \
    ((STREAKS_ROUGH << (2 * SCENERY_KIND_WALL)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_GLASS)) |   \
     (STREAKS_PUDDLE << (2 * SCENERY_KIND_ROOF)) | (STREAKS_FILM << (2 * SCENERY_KIND_ASPHALT)) |  \
     (STREAKS_FILM << (2 * SCENERY_KIND_PAVING)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_METAL)) |  \
     (STREAKS_ROUGH << (2 * SCENERY_KIND_EARTH)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_LEAVES)) | \
     (STREAKS_PUDDLE << (2 * SCENERY_KIND_WATER)) | (STREAKS_SMOOTH << (2 * SCENERY_KIND_LIGHT)))

// The index of the first word of the surface under a particle; below 0 if none is known, as on the
// ground plane.
RG_FN int streaks_surface(rg_ctx rg, streaks_params p, streaks_particle t)
{
    streaks_map_place at =
        streaks_map_place_at(p, t.x, t.y, numbers_width(rg, 0), numbers_height(rg, 0));
    uint number = numbers_bytes(rg, at.x, at.y, 0, 0);
    int known = (1 - at.outside) * (number != SCENERY_NO_SURFACE ? 1 : 0);
    return rg_to_int(number * rg_to_uint(known)) * SCENERY_SURFACE_WORDS + known - 1;
}

// The material under a particle, 0 to 3. The ground plane, where nothing else is hit, has a film
// like streets.
RG_FN int streaks_material(rg_ctx rg, streaks_params p, streaks_particle t)
{
    int at = streaks_surface(rg, p, t);
    int known = p.materials * (1 - (at < 0 ? 1 : 0));
    uint look = surfaces_at(rg, rg_imax(at, 0) + SCENERY_LOOK);
    return known * rg_to_int((STREAKS_MATERIALS >> (2u * scenery_kind(look))) & 3u);
}

// A vector scaled to length 1, or shorter if it is almost 0.
RG_FN v3 streaks_unit(v3 d)
{
    return v3_scale(d, 1.0f / rg_sqrt(rg_max(v3_dot(d, d), 1e-12f)));
}

// The upward direction for a splash, of length 1: the surface's normal on the side that rain falls
// on. The stored normal is longer or shorter by up to 0.2 %.
RG_FN v3 streaks_up(rg_ctx rg, streaks_params p, streaks_particle t)
{
    int at = streaks_surface(rg, p, t);
    v3 n = mesh_normal_unpack(surfaces_at(rg, rg_imax(at, 0) + SCENERY_NORMAL));
    v3 turned = v3_make(p.from_world.xx * n.x + p.from_world.xy * n.y + p.from_world.xz * n.z,
                        p.from_world.yx * n.x + p.from_world.yy * n.y + p.from_world.yz * n.z,
                        p.from_world.zx * n.x + p.from_world.zy * n.y + p.from_world.zz * n.z);
    float side = turned.z > 0.0f ? -1.0f : 1.0f;
    int follows = p.follows * (1 - (at < 0 ? 1 : 0));
    return streaks_unit(v3_make(follows != 0 ? turned.x * side : p.up_x,
                                follows != 0 ? turned.y * side : p.up_y,
                                follows != 0 ? turned.z * side : p.up_s));
}

// The distance along the fall from a texel's middle, which the map knows, to the particle's place
// on the texel's surface, if splashes follow surfaces. Neighbouring texels do not count, so that
// the edge of a roof has no slope between it and the ground. Slopes are capped at 76 degrees. A
// product makes the choice, as in streaks_hit.
RG_FN float streaks_slope(rg_ctx rg, streaks_params p, streaks_particle t, v3 up)
{
    int width = numbers_width(rg, 0);
    int height = numbers_height(rg, 0);
    streaks_map_place at = streaks_map_place_at(p, t.x, t.y, width, height);
    float x = p.map_x + (rg_to_float(at.x) + 0.5f) / (p.map_per_x * rg_to_float(width));
    float y = p.map_y + (rg_to_float(at.y) + 0.5f) / (p.map_per_y * rg_to_float(height));
    float further = (up.x * (t.x - x) + up.y * (t.y - y)) / rg_max(-up.z, 0.25f);
    int follows = p.follows * (1 - (streaks_surface(rg, p, t) < 0 ? 1 : 0));
    return further * rg_to_float(follows);
}

#endif
