// flow: the mean of a texel and its eight neighbours, which smooths the steps that thresholds leave
// (section 4.3, figures 14 and 15). Beyond the edge the pane is dry.
#include "kernels/flow/water/water.h"

#define RG_PARAMS flow_params
#define RG_SLOTS  IN(1, float, water) OUT(2, float, blurred)
#include "kernels/dialect/slots/slots.h"

RG_FN float row_sum(rg_ctx rg, flow_params p, int z, int x, int y)
{
    int i = flow_pane_index(p.size, z, x, y);
    return (water_at(rg, i - 1) + water_at(rg, i)) + water_at(rg, i + 1);
}

RG_GRID_KERNEL(flow_blur)
{
    float sum =
        (row_sum(rg, p, z, x, y - 1) + row_sum(rg, p, z, x, y)) + row_sum(rg, p, z, x, y + 1);
    int i = flow_pane_index(p.size, z, x, y);
    blurred_put(rg, i, p.blur != 0 ? sum * (1.0f / 9.0f) : water_at(rg, i));
}
