// Adds the water that running drops leave on their way of one substep (wet.h). Each item takes
// every eighth row of a drop's blocks.
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, drops_drop, drops) IN(2, float, ways) ATOMIC(3, uint, height) ATOMIC(4, uint, ids)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/wet.h"

RG_PROC void raise_row(rg_ctx rg, drops_params p, drops_way w, int place, drops_block b, int row)
{
    for (int column = b.left; column <= b.right; column++) {
        float h = drops_height(p, w, place, column, row);
        if (h > 0.0f)
            raise_to(rg, drops_cell(p, column, row), h);
    }
}

RG_GRID_KERNEL(drops_trail)
{
    drops_drop d = drops_at(rg, x);
    if (d.runs == 0u)
        return;
    int place = 2 * (x * (p.substeps + 1) + p.substep);
    drops_way w = drops_way_of(p, d.mass, ways_at(rg, place), ways_at(rg, place + 1),
                               ways_at(rg, place + 2), ways_at(rg, place + 3));
    for (int i = 0; i < w.places; i++) {
        drops_block b = drops_block_of(p, w, i);
        for (int row = b.top + y; row <= b.bottom; row += DROPS_ROWS_A_DROP)
            raise_row(rg, p, w, i, b, row);
    }
}
