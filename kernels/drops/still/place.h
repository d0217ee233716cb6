// Drops at rest raise the water in spoiled tiles (rest.h).
#include "kernels/drops/params.h"

#define RG_PARAMS drops_params
#define RG_SLOTS                                                                                   \
    IN(1, drops_drop, drops)                                                                       \
    IN(2, uint, tally) ATOMIC(3, uint, tiles) ATOMIC(4, uint, height) ATOMIC(5, uint, ids)
#include "kernels/dialect/slots/slots.h"

#include "kernels/drops/still/rest.h"
#include "kernels/drops/wet.h"

RG_GRID_KERNEL(drops_place)
{
    if (x >= rg_to_int(tally_at(rg, DROPS_COUNT)))
        return;
    drops_drop d = drops_at(rg, x);
    drops_way w = at_rest(p, d);
    drops_block b = drops_block_of(p, w, 0);
    if (d.rests == 0u || !is_any_spoiled(rg, p, b))
        return;
    for (int row = b.top + y; row <= b.bottom; row += DROPS_ROWS_A_DROP)
        for (int column = b.left; column <= b.right; column++) {
            float h = height_of(rg, p, w, column, row);
            if (h > 0.0f)
                raise_to(rg, drops_cell(p, column, row), h);
        }
}
