// The plane over which particles are scattered, as a lattice; its parts, their halves, and the
// density map in them.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_PART_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_PART_H

#include <stdbool.h>
#include <stdint.h>

#include "core/scene/density.h"
#include "kernels/dialect/rng.h"

enum {
    STREAKS_LATTICE_BITS = 24,
    STREAKS_DEEPEST = 2 * STREAKS_LATTICE_BITS, // halvings down to a single lattice point
};

// A field of particles to scatter.
struct streaks_scatter {
    const struct rg_density *density; // NULL: uniform
    uint32_t seed;
    uint32_t field;        // seed; different fields are independent
    double size_x, size_y; // of the plane, in clip coordinates from -1, -1 on
};

// A lattice point's clip coordinate over the whole plane, which is exact, and the inverse.
static inline float streaks_clip_of(uint32_t lattice)
{
    return (float)((2.0 * lattice + 1) / (1 << STREAKS_LATTICE_BITS) - 1);
}

static inline uint32_t streaks_lattice_of(float clip)
{
    return (uint32_t)(((double)clip + 1) * (1 << (STREAKS_LATTICE_BITS - 1)));
}

// The purposes of random numbers: the last word of their counters, beside the field.
enum { STREAKS_SPLITS = 1, STREAKS_PLACES = 2, STREAKS_PURPOSES = 4 };

// A part: its first lattice point, the number of halvings, and its particles.
struct streaks_part {
    uint32_t x, y;
    int depth; // even: the next halving is across y
    int64_t first, count;
};

// log2 of a part's width or height in lattice points.
static inline int streaks_bits_x(const struct streaks_part *part)
{
    return STREAKS_LATTICE_BITS - part->depth / 2;
}

static inline int streaks_bits_y(const struct streaks_part *part)
{
    return STREAKS_LATTICE_BITS - (part->depth + 1) / 2;
}

// Whether a part lies in one texel, so that its density is uniform.
bool streaks_part_even(const struct streaks_scatter *scatter, const struct streaks_part *part);
// Halves a part and divides its particles at random, by the map's density.
void streaks_part_halve(const struct streaks_scatter *scatter, const struct streaks_part *part,
                        struct streaks_part halves[2]);
// The lattice point that two random words choose in a part of varying density.
void streaks_part_place(const struct rg_density *map, const struct streaks_part *part,
                        rg_uint4 random, uint32_t *x, uint32_t *y);

#endif
