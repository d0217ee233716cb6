// A step of the water: each column gives a share to each of its four neighbours, or past the grid's
// edge, where it runs off. A share of the rest then evaporates.
#include "kernels/cartoon/water/params.h"

#define RG_PARAMS cartoon_water_params
#define RG_SLOTS  IN(1, uint, water) OUT(2, uint, water_next) ATOMIC(3, uint, account)
#include "kernels/dialect/slots/slots.h"

RG_FN bool cartoon_is_column(int x, int y)
{
    return x >= 0 && x < CARTOON_COLUMNS && y >= 0 && y < CARTOON_COLUMNS;
}

RG_FN uint cartoon_given(rg_ctx rg, cartoon_water_params p, int x, int y)
{
    int held_x = rg_iclamp(x, 0, CARTOON_COLUMNS - 1);
    int held_y = rg_iclamp(y, 0, CARTOON_COLUMNS - 1);
    uint given = rg_mul_hi(water_at(rg, held_y * CARTOON_COLUMNS + held_x), p.spread);
    return cartoon_is_column(x, y) ? given : 0u;
}

RG_GRID_KERNEL(cartoon_spread)
{
    int column = x % CARTOON_COLUMNS;
    int row = x / CARTOON_COLUMNS;
    uint here = water_at(rg, x);
    uint given = rg_mul_hi(here, p.spread);
    uint taken = cartoon_given(rg, p, column - 1, row) + cartoon_given(rg, p, column + 1, row) +
                 cartoon_given(rg, p, column, row - 1) + cartoon_given(rg, p, column, row + 1);
    uint beyond = (cartoon_is_column(column - 1, row) ? 0u : given) +
                  (cartoon_is_column(column + 1, row) ? 0u : given) +
                  (cartoon_is_column(column, row - 1) ? 0u : given) +
                  (cartoon_is_column(column, row + 1) ? 0u : given);
    uint left = here - 4u * given + taken;
    // Rounds up, so that the last units evaporate too.
    uint dried = left == 0u ? 0u : rg_mul_hi(left - 1u, p.dried) + 1u;
    water_next_put(rg, x, left - dried);
    if (dried != 0u)
        account_add(rg, CARTOON_WATER_DRIED, dried);
    if (beyond != 0u)
        account_add(rg, CARTOON_WATER_RUN, beyond);
}
