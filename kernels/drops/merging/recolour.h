// Water that merges gets the ID of the new drop. If its set has only one drop left, it gets that
// one's ID; if none, that of the set's first cell (section 4.3).
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    INOUT(1, uint, ids)                                                                            \
    IN(2, uint, hot)                                                                               \
    IN(3, drops_drop, drops)                                                                       \
    ATOMIC(4, uint, labels)                                                                        \
    IN(5, uint, leaders)                                                                           \
    IN(6, uint, sums)                                                                              \
    IN(7, uint, before) ATOMIC(8, uint, tally) ATOMIC(9, uint, tiles) IN(10, uint, heat)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/heat.h"
#include "kernels/drops/sets/ids.h"
#include "kernels/drops/sets/sets.h"
#include "kernels/drops/tiles/stir.h"
#include "kernels/drops/merging/sums.h"

RG_FN uint id_after(rg_ctx rg, drops_params p, uint set)
{
    int leader = leader_in(rg, set);
    if (leader >= 0)
        return id_of_slot(rg, p, merged_slot(p, leader));
    uint only = leaders_at(rg, rg_to_int(set));
    return only != DROPS_NOBODY ? drops_at(rg, rg_to_int(only)).id
                                : drops_owner(ids_at(rg, rg_to_int(set)));
}

RG_PROC void colour(rg_ctx rg, drops_params p, int column, int row, uint id)
{
    int cell = drops_cell(p, column, row);
    uint was = ids_at(rg, cell);
    if (id == drops_owner(was))
        return;
    ids_put(rg, cell, id | (was & DROPS_RISEN));
    mark_row(rg, p, row, column, column, DROPS_AWAKE | DROPS_STIRRED);
}

RG_PROC void colour_cells(rg_ctx rg, drops_params p, int left, int row)
{
    int first = drops_cell(p, left, row);
    uint label = DROPS_NOBODY; // of the cell before; `id` is the one that its set gets
    uint id = 0u;
    for (int i = 0; i < DROPS_TILE_COLUMNS; i++) {
        if (is_hot(rg, first + i)) {
            uint own = labels_load(rg, first + i);
            if (own != label)
                id = id_after(rg, p, first_of(rg, own));
            label = own;
            colour(rg, p, left + i, row, id);
        }
    }
}

RG_PROC void colour_row(rg_ctx rg, drops_params p, int left, int row)
{
    int first = drops_cell(p, left, row);
    uint id = id_after(rg, p, first_of(rg, labels_load(rg, first)));
    if (id == drops_owner(ids_at(rg, first)))
        return;
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++)
        ids_put(rg, cell, id | (ids_at(rg, cell) & DROPS_RISEN));
    mark_row(rg, p, row, left, left + DROPS_TILE_COLUMNS - 1, DROPS_AWAKE | DROPS_STIRRED);
}

RG_GRID_KERNEL(drops_recolour)
{
    int row = drops_row_of(p, y);
    uint heat = heat_at(rg, heat_of(p, x, row));
    if (heat == DROPS_UNIFORM)
        colour_row(rg, p, x * DROPS_TILE_COLUMNS, row);
    if (heat == DROPS_HOT)
        colour_cells(rg, p, x * DROPS_TILE_COLUMNS, row);
}
