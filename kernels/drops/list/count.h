// Counts the drops after some have come and gone, and sets the next ID.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  IN(1, uint, before) ATOMIC(2, uint, tally)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/ids.h"

RG_GRID_KERNEL(drops_count)
{
    uint stay = before_at(rg, p.slots);
    uint room = rg_to_uint(p.most) - stay;
    uint arrivals = rg_to_uint(p.arrivals);
    uint next = id_of_slot(rg, p, p.slots) + arrivals;
    tally_store(rg, DROPS_COUNT, stay + (arrivals < room ? arrivals : room));
    tally_store(rg, DROPS_NEXT_ID, next);
    tally_store(rg, DROPS_MEETS, 0u);
}
