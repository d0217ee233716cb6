// The free list and the active list, of drops and of splashes, as sums over the flags of free slots
// make them: both in the order of the slots. What is created in a step takes slots from the
// beginning of the free list, and stands at the end of the active one.
//
// The slot `before` holds the sums; lists of splashes begin at the number of drops' slots.
#ifndef RG_KERNELS_CARTOON_RAIN_LIFE_LISTS_H
#define RG_KERNELS_CARTOON_RAIN_LIFE_LISTS_H

RG_FN int cartoon_free_drops(rg_ctx rg, cartoon_rain_params p)
{
    return rg_to_int(before_at(rg, p.drop_slots));
}

RG_FN int cartoon_free_sprays(rg_ctx rg, cartoon_rain_params p)
{
    return rg_to_int(before_at(rg, p.drop_slots + p.spray_slots)) - cartoon_free_drops(rg, p);
}

// Drops of the active list, those that were released in this step included.
RG_FN int cartoon_active_drops(rg_ctx rg, cartoon_rain_params p)
{
    int unused = cartoon_free_drops(rg, p);
    return p.drop_slots - unused + rg_imin(p.released, unused);
}

#endif
