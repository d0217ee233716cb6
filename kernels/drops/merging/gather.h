// Adds up the mass and momentum of the drops that merge, in the sums of their leader.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, drops_drop, drops) IN(2, uint, joins) IN(3, uint, leaders) ATOMIC(4, uint, sums)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/merging/depth.h"

RG_FN uint momentum(drops_drop d, float velocity)
{
    return rg_to_uint(rg_to_int(rg_clamp(drops_mg(d.mass) * velocity * 4.0f, -2e9f, 2e9f)));
}

RG_GRID_KERNEL(drops_gather)
{
    uint set = joins_at(rg, x);
    if (set == DROPS_NOBODY)
        return;
    drops_drop d = drops_at(rg, x);
    int sum = rg_to_int(leaders_at(rg, rg_to_int(set))) * DROPS_SUM;
    sums_add(rg, sum + DROPS_SUM_MASS, d.mass);
    sums_add(rg, sum + DROPS_SUM_X, momentum(d, d.vx));
    sums_add(rg, sum + DROPS_SUM_Y, momentum(d, d.vy));
    sums_add(rg, sum + DROPS_SUM_MEMBERS, 1u);
    sums_max(rg, sum + DROPS_SUM_DEEPEST, drops_depth(p, d));
}
