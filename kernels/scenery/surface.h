// A surface of the scene: the data that all faces of one place, direction and material share. It is
// a row of words in a buffer, which every device fetches fastest.
#ifndef RG_KERNELS_SCENERY_SURFACE_H
#define RG_KERNELS_SCENERY_SURFACE_H

#include "kernels/dialect/mesh/normal.h"

// The words of a surface. Textures are fixed to the world. On ground and roofs, u runs along x and
// v along z, or, turned, u along z and v along x; on walls u runs to the right as seen from
// outside, and v along y. Places are in whole textures: u = scale_u * along + offset_u; v likewise.
#define SCENERY_SCALES        0 // u's and v's in 1 / SCENERY_SCALE_STEPS, 16 bits each with a sign
#define SCENERY_OFFSETS       1 // u's and v's in 1 / 65536
#define SCENERY_NORMAL        2 // mesh_normal_pack; above it two bits: how wet it gets, 0 to 3
#define SCENERY_LOOK          3 // see below
#define SCENERY_SURFACE_WORDS 4

#define SCENERY_SCALE_STEPS 8192.0f

// The look, from the lowest bit: the texture, 8 bits; the kind, 4; whether it is turned, 1; its own
// glow, 3; the texture's tint, a factor for r, g and b, 5, 6 and 5 bits.
#define SCENERY_KIND_BIT   8
#define SCENERY_TURNED_BIT 12
#define SCENERY_GLOW_BIT   13
#define SCENERY_TINT_BIT   16

// A surface whose normal has a y above this is ground or a roof.
#define SCENERY_LEVEL_Y 0.7f

RG_FN uint scenery_kind(uint look)
{
    return (look >> SCENERY_KIND_BIT) & 15u;
}

// Kinds of surface, on which rain splashes in different ways.
#define SCENERY_KIND_WALL    0
#define SCENERY_KIND_GLASS   1
#define SCENERY_KIND_ROOF    2
#define SCENERY_KIND_ASPHALT 3
#define SCENERY_KIND_PAVING  4
#define SCENERY_KIND_METAL   5
#define SCENERY_KIND_EARTH   6
#define SCENERY_KIND_LEAVES  7
#define SCENERY_KIND_WATER   8
#define SCENERY_KIND_LIGHT   9 // lamps: they glow
#define SCENERY_KINDS        10

// The number, in a map of surface numbers, where there is no surface.
#define SCENERY_NO_SURFACE 0xffffffffu

#endif
