// A surface of the scene: what all faces of one place, direction and material have in common. It
// is a row of words in a buffer, since rows of words are what every device fetches fastest.
#ifndef RG_KERNELS_STREAKS_SURFACE_H
#define RG_KERNELS_STREAKS_SURFACE_H

#include "lang.h"

// The words of a surface. Textures lie upon the world: at a place (x, y, z) a texture is fetched at
// (AX x + AZ z + A0, BX x + BY y + BZ z + B0), in whole textures.
#define STREAKS_AX            0 // floats, as their bits
#define STREAKS_AZ            1
#define STREAKS_A0            2
#define STREAKS_BX            3
#define STREAKS_BY            4
#define STREAKS_BZ            5
#define STREAKS_B0            6
#define STREAKS_DENSITY       7 // texels of level 0 a metre
#define STREAKS_NORMAL        8 // mesh_normal_pack
#define STREAKS_LOOK          9 // texture, then kind, then how much it glows by itself: 8 bits each
#define STREAKS_TINT          10 // the texture is multiplied by it: r, g, b of 8 bits
#define STREAKS_SURFACE_WORDS 11

// Kinds of surface: what rain splashes on, and how wet it gleams.
#define STREAKS_KIND_WALL    0
#define STREAKS_KIND_GLASS   1
#define STREAKS_KIND_ROOF    2
#define STREAKS_KIND_ASPHALT 3
#define STREAKS_KIND_PAVING  4
#define STREAKS_KIND_METAL   5
#define STREAKS_KIND_EARTH   6
#define STREAKS_KIND_LEAVES  7
#define STREAKS_KIND_WATER   8
#define STREAKS_KIND_LIGHT   9 // lamps: they glow
#define STREAKS_KINDS        10

#endif
