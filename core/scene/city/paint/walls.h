// Walls, facades with windows, curtain walls and shops.
#ifndef RG_CORE_SCENE_CITY_PAINT_WALLS_H
#define RG_CORE_SCENE_CITY_PAINT_WALLS_H

#include "core/scene/city/paint/spot.h"

// A kind of wall at (u, v), whose unit square has `across` x `down` bricks.
struct paint paint_wall(const struct spot *s, int wall, float u, float v, int across, int down);
struct paint paint_facade(const struct spot *s);
struct paint paint_curtain(const struct spot *s);
struct paint paint_shop(const struct spot *s);

#endif
