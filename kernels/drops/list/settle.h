// Flags the drops that stay: those that are on the pane and have not merged.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, drops_drop, drops)                                                                       \
    IN(2, uint, joins)                                                                             \
    IN(3, uint, leaders)                                                                           \
    IN(4, uint, sums) OUT(5, uint, flags) ATOMIC(6, uint, tally) ATOMIC(7, uint, tiles)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/tiles/stir.h"
#include "kernels/drops/merging/sums.h"

RG_GRID_KERNEL(drops_settle)
{
    drops_drop d = drops_at(rg, x);
    bool is_drop = d.mass > 0u;
    if (p.has_joined != 0 && x < p.count)
        is_drop = is_drop && leader_in(rg, joins_at(rg, x)) < 0;
    bool is_on = drops_holds(p, d.x, d.y);
    bool stays = is_drop && is_on && p.is_removal == 0;
    if (d.rests != 0u && !stays)
        spoil(rg, p, d);
    flags_put(rg, x, stays ? 1u : 0u);
    if (is_drop && !is_on) {
        tally_add(rg, DROPS_DRAINED, d.mass);
        tally_add(rg, DROPS_LEFT, 1u);
    }
    if (is_drop && is_on && p.is_removal != 0)
        tally_add(rg, DROPS_REMOVED, d.mass);
}
