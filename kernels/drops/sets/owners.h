// Owners of water, and whether their waters join when they touch. For kernels with the slots ids
// and drops.
#ifndef RG_KERNELS_DROPS_SETS_OWNERS_H
#define RG_KERNELS_DROPS_SETS_OWNERS_H

#include "kernels/drops/tiles/tiles.h"

// The index of the drop with this ID, or -1 if it has ended. Drops lie in the order of their IDs.
RG_FN int owner_of(rg_ctx rg, drops_params p, uint id)
{
    int low = 0;
    int high = p.count;
    while (low < high) {
        int middle = (low + high) / 2;
        if (drops_at(rg, middle).id < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low < p.count && drops_at(rg, low).id == id ? low : -1;
}

// A residual drop does not run back into the drop that left it (section 4.3).
RG_FN bool are_kin(rg_ctx rg, drops_params p, uint a, uint b)
{
    int owner_a = owner_of(rg, p, a);
    int owner_b = owner_of(rg, p, b);
    if (owner_a < 0 || owner_b < 0)
        return false;
    return drops_at(rg, owner_a).parent == b || drops_at(rg, owner_b).parent == a;
}

// Whether the waters of two adjacent cells become one.
RG_FN bool do_join(rg_ctx rg, drops_params p, uint a, uint b)
{
    if (a == 0u || b == 0u)
        return false;
    return a == b || !are_kin(rg, p, a, b);
}

#endif
