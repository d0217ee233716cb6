// Begins the sets of cells that are about to merge: each run of one owner's cells in a row of a
// tile is one, until link.h unites them.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS  IN(1, uint, ids) IN(2, uint, hot) OUT(3, uint, labels) OUT(4, uint, heat)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/sets/heat.h"

RG_FN uint heat_in(rg_ctx rg, int first)
{
    uint own = drops_owner(ids_at(rg, first));
    uint other = 0u;
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++)
        other = other | (drops_owner(ids_at(rg, cell)) ^ own);
    if (other == 0u)
        return is_hot(rg, first) ? DROPS_UNIFORM : DROPS_COLD;
    bool is_any = false;
    uint before = 0u;
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++) {
        uint id = ids_at(rg, cell);
        is_any = is_any || (id != before && is_hot(rg, cell));
        before = id;
    }
    return is_any ? DROPS_HOT : DROPS_COLD;
}

RG_PROC void label_runs(rg_ctx rg, int first)
{
    uint before = 0u;
    uint run = 0u;
    for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++) {
        uint own = drops_owner(ids_at(rg, cell));
        run = cell == first || own != before ? rg_to_uint(cell) : run;
        before = own;
        labels_put(rg, cell, run);
    }
}

RG_GRID_KERNEL(drops_label)
{
    int row = drops_row_of(p, y);
    int first = drops_first_in(p, x, row);
    uint heat = heat_in(rg, first);
    heat_put(rg, heat_of(p, x, row), heat);
    if (heat == DROPS_HOT)
        label_runs(rg, first);
    if (heat == DROPS_UNIFORM)
        for (int cell = first; cell < first + DROPS_TILE_COLUMNS; cell++)
            labels_put(rg, cell, rg_to_uint(first));
}
