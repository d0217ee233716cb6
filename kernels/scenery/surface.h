// A surface of the scene: what all faces of one place, direction and material have in common. It
// is a row of words in a buffer, since rows of words are what every device fetches fastest.
#ifndef RG_KERNELS_SCENERY_SURFACE_H
#define RG_KERNELS_SCENERY_SURFACE_H

#include "kernels/dialect/mesh/normal.h"

// The words of a surface. Textures lie upon the world. On ground and roofs, u runs along x and v
// along z, or, turned, u along z and v along x; on walls u runs to the right as seen from outside,
// and v along y. Places are in whole textures: u = scale_u * along + offset_u, likewise v.
#define STREAKS_SCALES        0 // u's and v's in 1 / STREAKS_SCALE_STEPS, 16 bits each with a sign
#define STREAKS_OFFSETS       1 // u's and v's in 1 / 65536
#define STREAKS_NORMAL        2 // mesh_normal_pack; above it two bits: how wet it gets, 0 to 3
#define STREAKS_LOOK          3 // see below
#define STREAKS_SURFACE_WORDS 4

#define STREAKS_SCALE_STEPS 8192.0f

// The look, from the lowest bit: the texture, 8 bits; the kind, 4; whether it is turned, 1; how
// much it glows by itself, 3; what the texture is multiplied by, r, g and b, 5, 6 and 5 bits.
#define STREAKS_KIND_BIT   8
#define STREAKS_TURNED_BIT 12
#define STREAKS_GLOW_BIT   13
#define STREAKS_TINT_BIT   16

// Above this y of its normal a surface is ground or a roof.
#define STREAKS_LEVEL_Y 0.7f

RG_FN uint streaks_kind(uint look)
{
    return (look >> STREAKS_KIND_BIT) & 15u;
}

// Kinds of surface: what rain splashes on.
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

// Where a map of surfaces' numbers shows none.
#define STREAKS_NO_SURFACE 0xffffffffu

#endif
