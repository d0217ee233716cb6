// Facades of buildings: walls that face streets.
#ifndef RG_CORE_SCENE_CITY_BUILDINGS_FACADE_H
#define RG_CORE_SCENE_CITY_BUILDINGS_FACADE_H

#include "core/scene/city/build.h"

// One side of a building's tier: a wall of bays and floors. Seen from outside, u runs to the right
// from the wall's lower left corner, d outwards from its front.
struct city_facade {
    double x, z;   // of the lower left corner
    point out;     // its outward normal
    double length; // metres
    double y0, floor_m, bay_m;
    int floors, bays;
    int texture; // PAINT_FACADE or PAINT_CURTAIN
    struct facade_style style;
    struct look wall;   // for parts without painted windows
    uint32_t painted;   // surface of its front
    double height_m;    // from y0 to its top
    double core, front; // the planes of the windows and of the wall, outwards
};

struct city_facades {
    int count;
    int64_t room;
    struct city_facade *facades;
};

// The point of a facade at u, height y and depth d.
point city_facade_at(const struct city_facade *f, double u, double y, double d);
// Adds the part of a facade from u0 to u1 and y0 to y1, at depth d.
void city_facade_quad(struct city_builder *b, const struct city_facade *f, double u0, double u1,
                      double y0, double y1, double d, uint32_t surface);
// The mapping that fits the texture's bays and floors to the facade's, upwards from y0.
struct mapping city_facade_mapping(const struct city_facade *f, double bays, double y0,
                                   double tall_m);
// Adds the windows' plane, behind the front, and sets `core`, `front` and `painted`.
void city_facade_core(struct city_builder *b, struct city_facade *f);
// Adds the posts at its ends: their fronts, and the sides that face the windows.
void city_facade_ends(struct city_builder *b, const struct city_facade *f, double y0);
// Adds it to the list of facades that get relief.
void city_facade_keep(struct city_builder *b, struct city_facades *all,
                      const struct city_facade *f);

#endif
