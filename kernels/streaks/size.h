// The sizes of drops: which class each belongs to, and what the frame knows of a class. Host and
// kernels share it.
#ifndef RG_KERNELS_STREAKS_SIZE_H
#define RG_KERNELS_STREAKS_SIZE_H

#include "kernels/dialect/lang.h"

// Classes lie before the blocks, as bits of floats: a drop's radius, speed and frequency in those
// of the settings' drop, how many drops it stands for, and how far around the local space it has
// come since the start, in turns.
#define STREAKS_SIZE_WORDS 5

// A number that looks random, of a particle: for what need not be random.
RG_FN uint streaks_hash(uint particle)
{
    uint h = particle * 0x9e3779b9u;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    return h ^ (h >> 13);
}

// Of `sizes` classes, a power of 2 up to 4096, which are equally frequent. The hash's other bits
// are spent on where a drop's swing begins, and on how splashes differ.
RG_FN int streaks_size_class(uint particle, int sizes)
{
    return rg_to_int((streaks_hash(particle) >> 14) & rg_to_uint(sizes - 1));
}

#endif
