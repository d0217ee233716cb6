// shower: new particles are born into free slots, in the order of the free list (eq. 1). Item 0
// also counts.
#include "kernels/shower/birth.h"

#define RG_PARAMS shower_params
#define RG_SLOTS                                                                                   \
    OUT(1, float, particles)                                                                       \
    IN(2, uint, unused) IN(3, uint, found) OUT(4, float, attributes) INOUT(5, uint, tally)
#include "kernels/dialect/slots/slots.h"

#include "kernels/shower/renewal/place.h"

// The number of new particles: those wanted less those there, at least 0, at most the free slots.
RG_FN int shower_births(shower_params p, int unused)
{
    return rg_iclamp(p.wanted - (p.slots - unused), 0, unused);
}

RG_GRID_KERNEL(shower_bear)
{
    int unused = rg_to_int(found_at(rg, 0));
    int births = shower_births(p, unused);
    if (x == 0) {
        uint survived = rg_to_uint(p.slots - unused);
        tally_put(rg, SHOWER_DIED,
                  tally_at(rg, SHOWER_DIED) + tally_at(rg, SHOWER_ALIVE) - survived);
        tally_put(rg, SHOWER_BORN, tally_at(rg, SHOWER_BORN) + rg_to_uint(births));
        tally_put(rg, SHOWER_ALIVE, survived + rg_to_uint(births));
    }
    if (x >= births)
        return;
    int slot = rg_to_int(unused_at(rg, x));
    shower_put(rg, p, slot, shower_born(p, slot), p.is_full);
}
