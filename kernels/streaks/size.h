// The sizes of drops: the class of each drop, and the words of a class. Host and kernels share this
// file.
#ifndef RG_KERNELS_STREAKS_SIZE_H
#define RG_KERNELS_STREAKS_SIZE_H

#include "kernels/dialect/lang.h"

// Classes lie before the blocks, as bits of floats: a drop's radius, speed and frequency relative
// to the settings' drop, the number of drops that it stands for, and its way since the start, in
// turns around the local space.
#define STREAKS_SIZE_WORDS 5

// A particle's pseudo-random number, for purposes that need no good one.
RG_FN uint streaks_hash(uint particle)
{
    uint h = particle * 0x9e3779b9u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    return h ^ (h >> 13);
}

// The class of a particle, of `sizes` equally frequent ones, a power of 2 up to 4096. The hash's
// other bits decide where a drop's swing begins, and how splashes differ.
RG_FN int streaks_size_class(uint particle, int sizes)
{
    return rg_to_int((streaks_hash(particle) >> 14) & rg_to_uint(sizes - 1));
}

#endif
