// Resets the buffers before waters merge: no drop takes part.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  OUT(1, uint, joins) OUT(2, uint, sums)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(drops_part)
{
    joins_put(rg, x, DROPS_NOBODY);
    for (int i = 0; i < DROPS_SUM_LOWEST; i++)
        sums_put(rg, x * DROPS_SUM + i, 0u);
    sums_put(rg, x * DROPS_SUM + DROPS_SUM_LOWEST, DROPS_NOBODY);
}
