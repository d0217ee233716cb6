// Throws particles over a plane as a density map asks, in the order of a Morton curve, in parallel.
//
// The plane is a lattice of 2^24 x 2^24 points, which floats hold exactly as clip coordinates. It
// is halved again and again, across y and x in turn. How many of a part's particles lie in its
// first half is drawn exactly: a binomial number, from coins of random bits, integers alone. Parts
// of few particles are filled and sorted along the curve. So each part depends on its own place
// alone, and the whole on neither threads nor the machine.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_SCATTER_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_SCATTER_H

#include <stdint.h>

#include "core/scene/density.h"

enum {
    STREAKS_LATTICE_BITS = 24,
    STREAKS_DEEPEST = 2 * STREAKS_LATTICE_BITS, // halvings, until one lattice point is left
};

struct streaks_scatter {
    const struct rg_density *density; // NULL: evenly
    uint32_t seed;
    uint32_t field;        // different fields have nothing in common
    double size_x, size_y; // of the plane, in clip coordinates: it begins at -1, -1
};

// Writes 3 floats a particle: x, y, oscillation + start.
void streaks_scatter(const struct streaks_scatter *scatter, int64_t count, float *particles);

// How many leaves a quad-tree over these particles has that hold some, at most `size` each.
int64_t streaks_scatter_quads(const struct streaks_scatter *scatter, int64_t count, int size);

// The clip coordinate of a lattice point over the whole plane, exact, and back.
static inline float streaks_clip_of(uint32_t lattice)
{
    return (float)((2.0 * lattice + 1) / (1 << STREAKS_LATTICE_BITS) - 1);
}

static inline uint32_t streaks_lattice_of(float clip)
{
    return (uint32_t)(((double)clip + 1) * (1 << (STREAKS_LATTICE_BITS - 1)));
}

#endif
