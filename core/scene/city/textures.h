// The numbers of the city's textures, and their properties that the geometry needs.
#ifndef RG_CORE_SCENE_CITY_TEXTURES_H
#define RG_CORE_SCENE_CITY_TEXTURES_H

#include <assert.h>

#include "core/scene/city/city.h"

// The first texture of each group; it ends where the next group begins.
enum {
    PAINT_FACADE = 0, // walls with windows: PAINT_CELLS x PAINT_CELLS bays
    PAINT_CURTAIN = 72,
    PAINT_SHOP = 96, // ground floors: a shop
    PAINT_WALL = 108,
    PAINT_ROOF = 124,
    PAINT_ASPHALT = 130, // plain, a street's width, the avenue's width
    PAINT_PAVING = 133,  // slabs, kerb, plaza, cobbles, tiles
    PAINT_CROSSING = 138,
    PAINT_STOP = 139,
    PAINT_METAL = 140, // grey, dark, painted
    PAINT_GRASS = 143,
    PAINT_LEAVES = 144,
    PAINT_BARK = 146,
    PAINT_LIGHT = 147,
    PAINT_WATER = 148,
    PAINT_CELLS = 4,
    PAINT_WALLS = PAINT_ROOF - PAINT_WALL,
};
static_assert(PAINT_WATER + 1 == CITY_TEXTURES, "every texture has a painter");

// The place of a facade's window in its bay, as shares of the bay's width and of the floor's
// height.
struct facade_style {
    double left, right, bottom, top; // bottom: from the floor's lower edge
    int wall;                        // the plain texture of the wall, for parts without windows
    double depth_m;                  // depth of windows in the wall
};
struct facade_style city_facade_style(const struct city_settings *settings, int texture);

// The sign over a shop's windows, as shares of the texture's height from below.
#define CITY_SIGN_LOW  0.74f
#define CITY_SIGN_HIGH 0.90f
// Whether a shop's sign shines, and the linear colour of its light, of luminance 1.
bool city_shop_sign(const struct city_settings *settings, int texture, float tint[3]);

#endif
