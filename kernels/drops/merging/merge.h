// Drops that merge become a new one, in a slot of its own, with their mass and momentum, at the
// lowest one's place (section 4.3). The old ones end.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    INOUT(1, drops_drop, drops)                                                                    \
    IN(2, uint, joins)                                                                             \
    IN(3, uint, leaders) IN(4, uint, sums) ATOMIC(5, uint, tally)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/merging/sums.h"

RG_FN float velocity(uint momentum, uint mass)
{
    return rg_to_float(rg_to_int(momentum)) * 0.25f / drops_mg(mass);
}

// The drop that a leader's drops become.
RG_FN drops_drop merged(rg_ctx rg, int leader)
{
    int sum = leader * DROPS_SUM;
    drops_drop d = drops_at(rg, rg_to_int(sums_at(rg, sum + DROPS_SUM_LOWEST)));
    d.parent = 0u;
    d.since_s = 0.0f;
    d.mass = sums_at(rg, sum + DROPS_SUM_MASS);
    d.vx = velocity(sums_at(rg, sum + DROPS_SUM_X), d.mass);
    d.vy = velocity(sums_at(rg, sum + DROPS_SUM_Y), d.mass);
    d.is_new = DROPS_BORN_NOW;
    d.rests = 0u;
    return d;
}

RG_GRID_KERNEL(drops_merge)
{
    int leader = leader_in(rg, joins_at(rg, x));
    drops_drop d = drops_at(rg, x);
    drops_drop now = d;
    now.mass = 0u;
    now.rests = 0u;
    if (leader == x) {
        now = merged(rg, leader);
        tally_add(rg, DROPS_MERGINGS, 1u);
    }
    drops_put(rg, merged_slot(p, x), now);
    if (leader >= 0)
        tally_add(rg, DROPS_MERGED, 1u);
}
