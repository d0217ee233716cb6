// The IDs of drops that came about in this step: those of their slots, in order, after all others.
// For kernels with the slots before and tally, which is ATOMIC.
#ifndef RG_KERNELS_DROPS_SETS_IDS_H
#define RG_KERNELS_DROPS_SETS_IDS_H

#include "kernels/drops/params.h"

RG_FN uint id_of_slot(rg_ctx rg, drops_params p, int slot)
{
    return tally_load(rg, DROPS_NEXT_ID) + before_at(rg, slot) - before_at(rg, p.count);
}

#endif
