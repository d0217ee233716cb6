// Normal numbers (Box and Muller).
#ifndef RG_KERNELS_DROPS_CHANCE_H
#define RG_KERNELS_DROPS_CHANCE_H

#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"

RG_FN float drops_normal(rg_uint4 words, float mean, float deviation)
{
    float u = 1.0f - rg_uniform(words.x); // above 0
    float turn = 6.2831853f * rg_uniform(words.y);
    return mean + deviation * rg_sqrt(-2.0f * rg_log(u)) * rg_cos(turn);
}

#endif
