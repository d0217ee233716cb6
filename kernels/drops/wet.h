// The water of drops on the pane's maps: the highest of all hemispheres, whichever drop is drawn
// first. A cell whose water rises is marked on the ID map. The drops that reach its height then
// claim it, and the oldest one gets it. For kernels with the slots height and ids, as uint.
#ifndef RG_KERNELS_DROPS_WET_H
#define RG_KERNELS_DROPS_WET_H

#include "kernels/drops/shape.h"

RG_PROC void raise_to(rg_ctx rg, int cell, float h)
{
    if (h <= rg_bits_float(height_load(rg, cell)))
        return;
    height_max(rg, cell, rg_float_bits(h));
    ids_store(rg, cell, DROPS_NOBODY);
}

RG_PROC void claim(rg_ctx rg, int cell, float h, uint id)
{
    if (ids_load(rg, cell) >= DROPS_RISEN && height_load(rg, cell) == rg_float_bits(h))
        ids_min(rg, cell, id | DROPS_RISEN);
}

#endif
