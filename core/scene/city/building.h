// Buildings: how they are cut out of blocks, and their facades, whose relief is added as long as
// there are triangles left. For this folder alone.
#ifndef RG_CORE_SCENE_CITY_BUILDING_H
#define RG_CORE_SCENE_CITY_BUILDING_H

#include "core/scene/city/build.h"

// A piece of a block, and which of its sides (BOX_X0 and so on) lie at the street.
struct city_lot {
    double x0, z0, x1, z1;
    int street;
    uint32_t id;
};

// One side of a building's tier: a wall of bays and floors. Seen from outside, u runs to the right
// from the wall's lower left corner, d outwards from its front.
struct city_facade {
    double x, z;   // of that corner
    point out;     // the way it looks
    double length; // metres
    double y0, floor_m, bay_m;
    int floors, bays;
    int texture; // PAINT_FACADE or PAINT_CURTAIN
    struct facade_style style;
    struct look wall;   // for what windows are not painted on
    uint32_t painted;   // the surface of its front
    double height_m;    // y0 to its top
    double core, front; // how far out the windows and the wall lie
};

struct city_facades {
    int count, room;
    struct city_facade *facades;
};

point city_facade_at(const struct city_facade *f, double u, double y, double d);
// A facade's frame and its windows' plane, behind the front.
void city_facade_core(struct city_builder *b, struct city_facade *f);
// relief.c: spends what is left of `triangles` on the facades' relief, to the last one.
void city_relief(struct city_builder *b, const struct city_facades *facades, int triangles);

// block.c: a block's lots; returns how many, at most CITY_MOST_LOTS.
enum { CITY_MOST_LOTS = 16 };
int city_lots(const struct city_builder *b, const struct city_block *block,
              struct city_lot lots[CITY_MOST_LOTS]);

#endif
