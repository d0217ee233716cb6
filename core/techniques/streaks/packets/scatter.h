// Scatters particles over a plane by a density map, in the order of a Morton curve, in parallel.
//
// The plane is a lattice of 2^24 x 2^24 points, which floats hold exactly as clip coordinates. It
// is halved repeatedly, across y and x in turn. The number of a part's particles in its first half
// is an exact binomial variate, drawn from random bits with integers alone. Small parts are filled
// and sorted along the curve. So each part depends only on its own place, and the result on neither
// threads nor the machine.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_SCATTER_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_SCATTER_H

#include "core/techniques/streaks/packets/part.h"

// Writes 3 floats for each particle: x, y, oscillation + start.
void streaks_scatter(const struct streaks_scatter *scatter, int64_t count, float *particles);

// The number of non-empty leaves of a quad-tree over these particles, at most `size` in each.
int64_t streaks_scatter_quads(const struct streaks_scatter *scatter, int64_t count, int size);

#endif
