// Facades of buildings: the walls that look at streets.
#ifndef RG_CORE_SCENE_CITY_BUILDINGS_FACADE_H
#define RG_CORE_SCENE_CITY_BUILDINGS_FACADE_H

#include "core/scene/city/build.h"

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
    int count;
    int64_t room;
    struct city_facade *facades;
};

// A point of a facade.
point city_facade_at(const struct city_facade *f, double u, double y, double d);
// A part of it, from u0 to u1 and y0 to y1, at d.
void city_facade_quad(struct city_builder *b, const struct city_facade *f, double u0, double u1,
                      double y0, double y1, double d, uint32_t surface);
// The texture so that its bays and floors are the facade's, upwards from y0.
struct mapping city_facade_mapping(const struct city_facade *f, double bays, double y0,
                                   double tall_m);
// Its windows' plane, behind the front, with `core`, `front` and `painted`.
void city_facade_core(struct city_builder *b, struct city_facade *f);
// The posts at its ends: their fronts and the sides that look to the windows.
void city_facade_ends(struct city_builder *b, const struct city_facade *f, double y0);
// Adds it to those that get relief.
void city_facade_keep(struct city_builder *b, struct city_facades *all,
                      const struct city_facade *f);

#endif
