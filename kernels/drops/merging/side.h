// Each drop whose water merges takes part in one merging. If its water lies in several sets of
// cells, it takes part in that of the first.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    ATOMIC(1, uint, tiles)                                                                         \
    IN(2, uint, ids) IN(3, drops_drop, drops) ATOMIC(4, uint, labels) ATOMIC(5, uint, joins)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/borders.h"
#include "kernels/drops/sets/owners.h"
#include "kernels/drops/sets/sets.h"
#include "kernels/drops/tiles/stir.h"

RG_PROC void take_side(rg_ctx rg, drops_params p, int cell, int beside)
{
    uint a = owner_at(rg, cell);
    uint b = owner_at(rg, beside);
    if (!do_border(a, b) || are_kin(rg, p, a, b))
        return;
    uint set = first_of(rg, rg_to_uint(cell));
    int owner_a = owner_of(rg, p, a);
    int owner_b = owner_of(rg, p, b);
    if (owner_a >= 0)
        joins_min(rg, owner_a, set);
    if (owner_b >= 0)
        joins_min(rg, owner_b, set);
}

RG_GRID_KERNEL(drops_side)
{
    int row = drops_row_of(p, y);
    int first = drops_first_in(p, x, row);
    bool is_top = row % DROPS_TILE_ROWS == 0;
    if (!is_awake_at(rg, p, x * DROPS_TILE_COLUMNS, row) || borders_in(rg, p, first, is_top) == 0u)
        return;
    take_side(rg, p, first, first - 1);
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++) {
        take_side(rg, p, cell, cell + 1);
        take_side(rg, p, cell, cell + p.stride);
        if (is_top)
            take_side(rg, p, cell, cell - p.stride);
    }
}
