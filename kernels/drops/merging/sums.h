// The mergings of drops. For kernels with the slots joins, leaders and sums.
#ifndef RG_KERNELS_DROPS_MERGING_SUMS_H
#define RG_KERNELS_DROPS_MERGING_SUMS_H

#include "kernels/drops/params.h"

// The drop that leads the merging of a set of cells; -1 if fewer than two take part.
RG_FN int leader_in(rg_ctx rg, uint set)
{
    if (set == DROPS_NOBODY)
        return -1;
    uint leader = leaders_at(rg, rg_to_int(set));
    if (leader == DROPS_NOBODY)
        return -1;
    int at = rg_to_int(leader);
    return sums_at(rg, at * DROPS_SUM + DROPS_SUM_MEMBERS) >= 2u ? at : -1;
}

// The slot of the drop that a leader's drops become.
RG_FN int merged_slot(drops_params p, int leader)
{
    return 2 * p.count + leader;
}

#endif
