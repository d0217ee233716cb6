// Clears the maps of drops at rest (rest.h) in spoiled tiles.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  ATOMIC(1, uint, tiles) OUT(2, float, still) OUT(3, uint, still_ids)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/still/rest.h"

RG_GRID_KERNEL(drops_clear)
{
    int row = drops_row_of(p, y);
    int first = drops_first_in(p, x, row);
    if (!is_spoiled(rg, drops_tile_of(p, x * DROPS_TILE_COLUMNS, row)))
        return;
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++) {
        still_put(rg, cell, 0.0f);
        still_ids_put(rg, cell, 0u);
    }
}
