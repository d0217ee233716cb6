// Walls, facades with windows, curtain walls and shops.
#ifndef RG_CORE_SCENE_CITY_PAINT_WALLS_H
#define RG_CORE_SCENE_CITY_PAINT_WALLS_H

#include "core/scene/city/paint/spot.h"

// A kind of wall at (u, v), whose unit square has `across` x `down` bricks.
struct paint paint_wall(const struct spot *s, int wall, float u, float v, int across, int down);
struct paint paint_facade(const struct spot *s);
struct paint paint_curtain(const struct spot *s);
struct paint paint_shop(const struct spot *s);
// Whether the sign of a shop's texture shines, and its mean light, scaled to a luminance of 1.
// Changes the spot's place.
bool paint_sign_light(struct spot *s, float tint[3]);

#endif
