// Drops that have hit in this step leave their volume in the column they fell into. From steep
// faces it runs off at once.
#include "kernels/cartoon/rain/params.h"
#include "kernels/cartoon/water/params.h"

#define RG_PARAMS cartoon_water_params
#define RG_SLOTS                                                                                   \
    IN(1, uint, living)                                                                            \
    IN(2, uint, hits)                                                                              \
    IN(3, cartoon_raindrop, raindrops)                                                             \
    IN(4, cartoon_surface, surfaces) ATOMIC(5, uint, water) ATOMIC(6, uint, account)
#include "kernels/dialect/slots/slots.h"

// A drop's volume goes by the cube of the side that the drop is drawn with.
RG_FN uint cartoon_units(cartoon_water_params p, float size)
{
    float side = p.least + (1.0f - p.least) * size;
    return rg_to_uint(rg_to_int(p.units * side * side * side + 0.5f));
}

RG_GRID_KERNEL(cartoon_gather)
{
    if (hits_at(rg, x) == 0u)
        return;
    cartoon_raindrop d = raindrops_at(rg, rg_to_int(living_at(rg, x)));
    uint units = cartoon_units(p, d.size);
    int column = rg_to_int(rg_floor((d.x - p.low_x) * p.per_column_x));
    int row = rg_to_int(rg_floor((d.z - p.low_z) * p.per_column_z));
    bool is_held = column >= 0 && column < CARTOON_COLUMNS && row >= 0 && row < CARTOON_COLUMNS &&
                   surfaces_at(rg, x).ny >= CARTOON_UPWARD;
    account_add(rg, CARTOON_WATER_HIT, units);
    if (is_held)
        water_add(rg, row * CARTOON_COLUMNS + column, units);
    else
        account_add(rg, CARTOON_WATER_RUN, units);
}
