// Ends a step: tiles that something has stirred are awake in the next one; others sleep.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  INOUT(1, uint, tiles) ATOMIC(2, uint, tally)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(drops_doze)
{
    uint bits = tiles_at(rg, x);
    if ((bits & DROPS_AWAKE) != 0u || p.does_sleep == 0)
        tally_add(rg, DROPS_TILES, 1u);
    tiles_put(rg, x, (bits & DROPS_STIRRED) != 0u ? DROPS_AWAKE : 0u);
}
