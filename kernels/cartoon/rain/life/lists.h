// The lists of a step. The free ones are in the order of the slots, and so are the living; what is
// created takes slots from the beginning of the free list, and stands at the end of the living one.
// Lists of splashes begin at the number of drops' slots.
#ifndef RG_KERNELS_CARTOON_RAIN_LIFE_LISTS_H
#define RG_KERNELS_CARTOON_RAIN_LIFE_LISTS_H

#include "kernels/cartoon/rain/params.h"

// Where in the list of the living those stand that are created in this step.
RG_FN int cartoon_new_drops(cartoon_rain_params p)
{
    return p.drop_slots - p.free_drops;
}

RG_FN int cartoon_new_sprays(cartoon_rain_params p)
{
    return p.drop_slots + p.spray_slots - p.free_sprays;
}

#endif
