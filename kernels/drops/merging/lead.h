// The oldest of the drops that take part in a merging leads it.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  IN(1, uint, joins) ATOMIC(2, uint, leaders)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(drops_lead)
{
    uint set = joins_at(rg, x);
    if (set != DROPS_NOBODY)
        leaders_min(rg, rg_to_int(set), rg_to_uint(x));
}
