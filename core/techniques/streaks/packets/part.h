// The plane over which particles are thrown, as a lattice; a part of it, its halves, and the
// density map inside it.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_PART_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_PART_H

#include <stdbool.h>
#include <stdint.h>

#include "core/scene/density.h"
#include "kernels/dialect/rng.h"

enum {
    STREAKS_LATTICE_BITS = 24,
    STREAKS_DEEPEST = 2 * STREAKS_LATTICE_BITS, // halvings, until one lattice point is left
};

// What is thrown.
struct streaks_scatter {
    const struct rg_density *density; // NULL: evenly
    uint32_t seed;
    uint32_t field;        // different fields have nothing in common
    double size_x, size_y; // of the plane, in clip coordinates: it begins at -1, -1
};

// The clip coordinate of a lattice point over the whole plane, exact, and back.
static inline float streaks_clip_of(uint32_t lattice)
{
    return (float)((2.0 * lattice + 1) / (1 << STREAKS_LATTICE_BITS) - 1);
}

static inline uint32_t streaks_lattice_of(float clip)
{
    return (uint32_t)(((double)clip + 1) * (1 << (STREAKS_LATTICE_BITS - 1)));
}

// What random numbers are for: the last word of their counters, beside the field.
enum { STREAKS_SPLITS = 1, STREAKS_PLACES = 2, STREAKS_PURPOSES = 4 };

// Its first lattice point, how often the plane was halved, and its particles.
struct streaks_part {
    uint32_t x, y;
    int depth; // even: the next halving is across y
    int64_t first, count;
};

// A part is 2^bits lattice points wide, or high.
static inline int streaks_bits_x(const struct streaks_part *part)
{
    return STREAKS_LATTICE_BITS - part->depth / 2;
}

static inline int streaks_bits_y(const struct streaks_part *part)
{
    return STREAKS_LATTICE_BITS - (part->depth + 1) / 2;
}

// Whether the density is the same all over a part: it lies in one texel.
bool streaks_part_even(const struct streaks_scatter *scatter, const struct streaks_part *part);
// Halves a part, and its particles with it: at random, as the map asks.
void streaks_part_halve(const struct streaks_scatter *scatter, const struct streaks_part *part,
                        struct streaks_part halves[2]);
// Of a part whose density is not even: the lattice point that two random words choose.
void streaks_part_place(const struct rg_density *map, const struct streaks_part *part,
                        rg_uint4 random, uint32_t *x, uint32_t *y);

#endif
