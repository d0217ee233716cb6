// A pass over the water (flattening.h) whose trails break into beads. Were that a second
// pass, heights would change twice in each step, and no tile would sleep.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    ATOMIC(1, uint, tiles)                                                                         \
    IN(2, float, height)                                                                           \
    IN(3, uint, ids)                                                                               \
    IN(4, float, still)                                                                            \
    IN(5, uint, still_ids)                                                                         \
    INOUT(6, float, next_height) INOUT(7, uint, next_ids) IN(8, float, held)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/water/cells.h"

// What the glass holds, and between beads none once the water is low.
RG_FN float beaded(rg_ctx rg, int cell, float thin)
{
    uint is_low = mask_of(thin < DROPS_BEAD_GAP_MM) & mask_of(still_at(rg, cell) == 0.0f);
    return rg_max(either(is_low, 0.0f, thin), rg_min(wet_at(rg, cell), held_at(rg, cell)));
}

#define LEFT_OF(rg, cell, thin) beaded(rg, cell, thin)
#include "kernels/drops/water/flattening.h"

RG_GRID_KERNEL(drops_flatten_beads)
{
    flatten(rg, p, x, y);
}
