// Cuts blocks into lots with one building each.
#ifndef RG_CORE_SCENE_CITY_BUILDINGS_LOTS_H
#define RG_CORE_SCENE_CITY_BUILDINGS_LOTS_H

#include "core/scene/city/build.h"

// A part of a block, and which of its sides (BOX_X0 and so on) face the street.
struct city_lot {
    double x0, z0, x1, z1;
    int street;
    uint32_t id;
};

enum { CITY_MOST_LOTS = 16 };

// Finds a block's lots; returns their number.
int city_lots(const struct city_builder *b, const struct city_block *block,
              struct city_lot lots[CITY_MOST_LOTS]);

#endif
