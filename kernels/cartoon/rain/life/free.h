// Flags the free slots: those of drops, then those of splashes.
#include "kernels/cartoon/rain/params.h"

#define RG_PARAMS cartoon_rain_params
#define RG_SLOTS  IN(1, cartoon_raindrop, raindrops) IN(2, cartoon_spray, sprays) OUT(3, uint, flags)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(cartoon_free)
{
    uint state = CARTOON_DEATH;
    if (x < p.drop_slots)
        state = raindrops_at(rg, x).state;
    else
        state = sprays_at(rg, x - p.drop_slots).state;
    flags_put(rg, x, state == CARTOON_DEATH ? 1u : 0u);
}
