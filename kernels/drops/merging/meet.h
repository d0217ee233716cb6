// Looks for waters of different owners side by side, and notes the IDs that are about to merge.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    ATOMIC(1, uint, tiles)                                                                         \
    IN(2, uint, ids)                                                                               \
    IN(3, drops_drop, drops) ATOMIC(4, uint, tally) ATOMIC(5, uint, hot)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/borders.h"
#include "kernels/drops/sets/hot.h"
#include "kernels/drops/sets/owners.h"
#include "kernels/drops/tiles/stir.h"

RG_PROC void note(rg_ctx rg, uint id)
{
    hot_or(rg, rg_to_int(hot_word(id)), hot_bit(id));
}

// A border that stays keeps its tile awake, since one side's owner may go.
RG_PROC void look(rg_ctx rg, drops_params p, int tile, int cell, int beside)
{
    uint a = owner_at(rg, cell);
    uint b = owner_at(rg, beside);
    if (!do_border(a, b))
        return;
    mark_tile(rg, tile, DROPS_STIRRED);
    if (are_kin(rg, p, a, b))
        return;
    tally_or(rg, DROPS_MEETS, 1u);
    note(rg, a);
    note(rg, b);
}

RG_GRID_KERNEL(drops_meet)
{
    int row = drops_row_of(p, y);
    int tile = drops_tile_of(p, x * DROPS_TILE_COLUMNS, row);
    int first = drops_first_in(p, x, row);
    bool is_top = row % DROPS_TILE_ROWS == 0;
    if (!is_awake(rg, p, tile) || borders_in(rg, p, first, is_top) == 0u)
        return;
    look(rg, p, tile, first, first - 1);
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++) {
        look(rg, p, tile, cell, cell + 1);
        look(rg, p, tile, cell, cell + p.stride);
        if (is_top)
            look(rg, p, tile, cell, cell - p.stride);
    }
}
