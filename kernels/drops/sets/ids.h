// The IDs of drops that are new in this step: they follow all others, in the order of their slots.
// For kernels with the slots before and tally, which is ATOMIC.
#ifndef RG_KERNELS_DROPS_SETS_IDS_H
#define RG_KERNELS_DROPS_SETS_IDS_H

#include "kernels/drops/params.h"

RG_FN uint id_of_slot(rg_ctx rg, drops_params p, int slot)
{
    return tally_load(rg, DROPS_NEXT_ID) + before_at(rg, slot) - before_at(rg, p.count);
}

#endif
