// Roofs, roads, pavements, metal and plants.
#ifndef RG_CORE_SCENE_CITY_PAINT_GROUND_H
#define RG_CORE_SCENE_CITY_PAINT_GROUND_H

#include "core/scene/city/paint/spot.h"

struct paint paint_ground(const struct spot *s);

#endif
