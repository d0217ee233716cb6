// The lists of a step, free and living slots, are in the order of the slots. A new particle takes
// the first slot of the free list, and is appended to the living one. Splashes' lists begin at
// element drop_slots.
#ifndef RG_KERNELS_CARTOON_RAIN_LIFE_LISTS_H
#define RG_KERNELS_CARTOON_RAIN_LIFE_LISTS_H

#include "kernels/cartoon/rain/params.h"

// The index in the list of the living at which those created in this step begin.
RG_FN int cartoon_new_drops(cartoon_rain_params p)
{
    return p.drop_slots - p.free_drops;
}

RG_FN int cartoon_new_sprays(cartoon_rain_params p)
{
    return p.drop_slots + p.spray_slots - p.free_sprays;
}

#endif
