// Contiguous water, of one ID or of several that merge, becomes one set of cells. The sets are
// those of a flood fill (section 4.3), in whatever order items run.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, ids)                                                                               \
    IN(2, uint, hot) IN(3, drops_drop, drops) ATOMIC(4, uint, labels) IN(5, uint, heat)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/borders.h"
#include "kernels/drops/sets/heat.h"
#include "kernels/drops/sets/owners.h"
#include "kernels/drops/sets/sets.h"

RG_PROC void link(rg_ctx rg, drops_params p, int cell, int beside)
{
    if (do_join(rg, p, owner_at(rg, cell), owner_at(rg, beside)))
        unite(rg, rg_to_uint(cell), rg_to_uint(beside));
}

// Links a cell to those on its right and below, unless its neighbours do: a run's cells are one set
// already, and two runs need only one link.
RG_PROC void link_cell(rg_ctx rg, drops_params p, int cell, bool is_first, bool is_last)
{
    uint own = owner_at(rg, cell);
    uint below = owner_at(rg, cell + p.stride);
    if (is_last || owner_at(rg, cell + 1) != own)
        link(rg, p, cell, cell + 1);
    bool begins = is_first || owner_at(rg, cell - 1) != own;
    if (begins || owner_at(rg, cell + p.stride - 1) != below)
        link(rg, p, cell, cell + p.stride);
}

RG_PROC void link_row(rg_ctx rg, drops_params p, int first, int last)
{
    for (int cell = first; cell <= last; cell++)
        if (is_hot(rg, cell))
            link_cell(rg, p, cell, cell == first, cell == last);
}

RG_GRID_KERNEL(drops_link)
{
    int row = drops_row_of(p, y);
    uint heat = heat_at(rg, heat_of(p, x, row));
    int first = drops_first_in(p, x, row);
    int last = first + DROPS_TILE_COLUMNS - 1;
    bool has_below = row + 1 < p.tile_rows * DROPS_TILE_ROWS;
    if (heat == DROPS_UNIFORM && has_below && heat_at(rg, heat_of(p, x, row + 1)) == heat) {
        link(rg, p, first, first + p.stride);
        link(rg, p, last, last + 1);
    } else if (heat != DROPS_COLD) {
        link_row(rg, p, first, last);
    }
}
