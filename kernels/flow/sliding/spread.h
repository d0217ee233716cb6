// flow: the pace of a drop's fastest cell spreads over the wet cells around it, so that the drop
// slides as a whole. A run reaches a cell farther.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, uint, slow) IN(2, float, cells) OUT(3, uint, fast)
#include "kernels/dialect/slots/slots.h"

RG_FN uint faster(uint a, uint b)
{
    return a > b ? a : b;
}

RG_FN uint fastest_of_row(rg_ctx rg, int i)
{
    return faster(slow_at(rg, i), faster(slow_at(rg, i - 1), slow_at(rg, i + 1)));
}

RG_GRID_KERNEL(flow_spread)
{
    int i = flow_pane_index(p.cells, z, x, y);
    int stride = flow_lattice_stride(p);
    uint around = faster(fastest_of_row(rg, i),
                         faster(fastest_of_row(rg, i - stride), fastest_of_row(rg, i + stride)));
    fast_put(rg, i, cells_at(rg, i) > p.joined ? around : slow_at(rg, i));
}
