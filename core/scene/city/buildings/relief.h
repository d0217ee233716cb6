// The facades' relief: bands between floors, piers between bays, sills and bars at windows.
#ifndef RG_CORE_SCENE_CITY_BUILDINGS_RELIEF_H
#define RG_CORE_SCENE_CITY_BUILDINGS_RELIEF_H

#include "core/scene/city/buildings/facade.h"

// Adds relief to the facades until all of `triangles` are used.
void city_relief(struct city_builder *b, const struct city_facades *facades, int triangles);

#endif
