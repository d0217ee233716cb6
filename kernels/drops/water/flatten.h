// A pass over the water (flattening.h) whose trails are left as they flatten and thin.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    ATOMIC(1, uint, tiles)                                                                         \
    IN(2, float, height)                                                                           \
    IN(3, uint, ids)                                                                               \
    IN(4, float, still)                                                                            \
    IN(5, uint, still_ids) INOUT(6, float, next_height) INOUT(7, uint, next_ids)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/water/cells.h"

#define LEFT_OF(rg, cell, thin) (thin)
#include "kernels/drops/water/flattening.h"

RG_GRID_KERNEL(drops_flatten)
{
    flatten(rg, p, x, y);
}
