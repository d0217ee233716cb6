// flow: water dries, and the lattice gets the mean height of its cells' texels, one map to
// be smoothed and one to stay. A run over cells.
// The square of a height falls at a constant rate, like that of a drying drop's radius (the d2
// law): films go at once, and beads last.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS                                                                                   \
    INOUT(1, float, water) INOUT(2, float, level) ATOMIC(3, uint, ledger) OUT(4, float, mean)
#include "kernels/dialect/slots/slots.h"

RG_FN float left_of(flow_slide_params p, float water)
{
    float square = rg_max(water * water - p.dried2, 0.0f);
    float droplets = rg_floor(rg_sqrt(square) * FLOW_DROPLETS_PER_UNIT + p.part);
    float dried = rg_min(square > 0.0f ? droplets * FLOW_DROPLET : 0.0f, water);
    return rg_min(p.dried2 > 0.0f ? dried : water, p.holds);
}

// Idle: dry cells, which stay dry.
#define RG_IDLE_ITEMS 4
RG_GRID_IDLE(flow_level)
{
    int k = p.texels_a_cell;
    int wide = rg_imin(x * k + count * k, p.size) - x * k;
    int bottom = rg_imin((y + 1) * k, p.size);
    uint wet = 0u;
    for (int row = y * k; row < bottom; row++)
        for (int column = 0; column < wide; column++)
            wet =
                wet | rg_float_bits(water_at(rg, flow_pane_index(p.size, z, x * k + column, row)));
    for (int c = 0; c < count; c++)
        wet = wet | rg_float_bits(level_at(rg, flow_pane_index(p.cells, z, x + c, y)));
    return wet == 0u;
}

RG_GRID_KERNEL(flow_level)
{
    float sum = 0.0f;
    float gone = 0.0f;
    int k = p.texels_a_cell;
    int right = rg_imin((x + 1) * k, p.size);
    int bottom = rg_imin((y + 1) * k, p.size);
    for (int row = y * k; row < bottom; row++) {
        for (int column = x * k; column < right; column++) {
            int i = flow_pane_index(p.size, z, column, row);
            float water = water_at(rg, i);
            if (water > 0.0f) {
                float left = left_of(p, water);
                water_put(rg, i, left);
                gone = gone + (water - left);
                sum = sum + left;
            }
        }
    }
    float mean = sum / rg_to_float(k * k);
    level_put(rg, flow_pane_index(p.cells, z, x, y), mean);
    mean_put(rg, flow_pane_index(p.cells, z, x, y), mean);
    if (gone > 0.0f)
        ledger_add(rg, FLOW_LEDGER_DRAINED, rg_to_uint(gone * FLOW_DROPLETS_PER_UNIT));
}
