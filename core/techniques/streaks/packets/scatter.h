// Throws particles over a plane as a density map asks, in the order of a Morton curve, in parallel.
//
// The plane is a lattice of 2^24 x 2^24 points, which floats hold exactly as clip coordinates. It
// is halved again and again, across y and x in turn. How many of a part's particles lie in its
// first half is drawn exactly: a binomial number, from coins of random bits, integers alone. Parts
// of few particles are filled and sorted along the curve. So each part depends on its own place
// alone, and the whole on neither threads nor the machine.
#ifndef RG_CORE_TECHNIQUES_STREAKS_PACKETS_SCATTER_H
#define RG_CORE_TECHNIQUES_STREAKS_PACKETS_SCATTER_H

#include "core/techniques/streaks/packets/part.h"

// Writes 3 floats a particle: x, y, oscillation + start.
void streaks_scatter(const struct streaks_scatter *scatter, int64_t count, float *particles);

// How many leaves a quad-tree over these particles has that hold some, at most `size` each.
int64_t streaks_scatter_quads(const struct streaks_scatter *scatter, int64_t count, int size);

#endif
