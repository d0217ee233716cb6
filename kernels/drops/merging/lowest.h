// Finds the lowest of the drops that merge; the oldest one if several are as low.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, drops_drop, drops) IN(2, uint, joins) IN(3, uint, leaders) ATOMIC(4, uint, sums)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/merging/depth.h"

RG_GRID_KERNEL(drops_lowest)
{
    uint set = joins_at(rg, x);
    if (set == DROPS_NOBODY)
        return;
    int sum = rg_to_int(leaders_at(rg, rg_to_int(set))) * DROPS_SUM;
    if (sums_load(rg, sum + DROPS_SUM_DEEPEST) == drops_depth(p, drops_at(rg, x)))
        sums_min(rg, sum + DROPS_SUM_LOWEST, rg_to_uint(x));
}
