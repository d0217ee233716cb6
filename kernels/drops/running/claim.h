// Running drops claim the water that they left in this step (wet.h).
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, drops_drop, drops) IN(2, float, ways) ATOMIC(3, uint, height) ATOMIC(4, uint, ids)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/wet.h"

RG_PROC void claim_row(rg_ctx rg, drops_params p, drops_way w, uint id, int place, drops_block b,
                       int row)
{
    for (int column = b.left; column <= b.right; column++) {
        float h = drops_height(p, w, place, column, row);
        if (h > 0.0f)
            claim(rg, drops_cell(p, column, row), h, id);
    }
}

RG_PROC void claim_way(rg_ctx rg, drops_params p, drops_way w, uint id, int first_row)
{
    for (int i = 0; i < w.places; i++) {
        drops_block b = drops_block_of(p, w, i);
        for (int row = b.top + first_row; row <= b.bottom; row += DROPS_ROWS_A_DROP)
            claim_row(rg, p, w, id, i, b, row);
    }
}

RG_GRID_KERNEL(drops_claim)
{
    drops_drop d = drops_at(rg, x);
    if (d.runs == 0u)
        return;
    for (int substep = 0; substep < p.substeps; substep++) {
        int place = 2 * (x * (p.substeps + 1) + substep);
        drops_way w = drops_way_of(p, d.mass, ways_at(rg, place), ways_at(rg, place + 1),
                                   ways_at(rg, place + 2), ways_at(rg, place + 3));
        claim_way(rg, p, w, d.id, y);
    }
}
