// Finds waters of different owners that lie side by side. For kernels with the slot ids.
#ifndef RG_KERNELS_DROPS_SETS_BORDERS_H
#define RG_KERNELS_DROPS_SETS_BORDERS_H

#include "kernels/drops/tiles/tiles.h"

RG_FN uint owner_at(rg_ctx rg, int cell)
{
    return drops_owner(ids_at(rg, cell));
}

// Waters of two owners meet.
RG_FN bool do_border(uint a, uint b)
{
    return a != b && a != 0u && b != 0u;
}

// Counts the borders with other water in a row of a tile that begins at cell `first`: to each
// cell's right and below. At the tile's edges also to the left and above, because the tile there
// may be asleep.
RG_FN uint borders_in(rg_ctx rg, drops_params p, int first, bool is_top)
{
    uint borders = do_border(owner_at(rg, first), owner_at(rg, first - 1)) ? 1u : 0u;
    int above = is_top ? -p.stride : p.stride;
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++) {
        uint own = owner_at(rg, cell);
        uint right = owner_at(rg, cell + 1);
        uint below = owner_at(rg, cell + p.stride);
        uint beside = owner_at(rg, cell + above);
        borders += do_border(own, right) ? 1u : 0u;
        borders += do_border(own, below) ? 1u : 0u;
        borders += do_border(own, beside) ? 1u : 0u;
    }
    return borders;
}

#endif
