// flow: smooths a map of the lattice once, by a weighted mean of a cell and the eight around it.
// Beyond the pane it is dry. Several runs come close to a Gaussian.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, rough) OUT(2, float, even)
#include "kernels/dialect/slots/slots.h"

RG_FN float row_mean(rg_ctx rg, flow_slide_params p, int i)
{
    float sides = rough_at(rg, i - 1) + rough_at(rg, i + 1);
    return rough_at(rg, i) * (1.0f - 2.0f * p.side_weight) + sides * p.side_weight;
}

RG_GRID_KERNEL(flow_smooth)
{
    int i = flow_pane_index(p.cells, z, x, y);
    int stride = flow_lattice_stride(p);
    float sides = row_mean(rg, p, i - stride) + row_mean(rg, p, i + stride);
    even_put(rg, i, row_mean(rg, p, i) * (1.0f - 2.0f * p.side_weight) + sides * p.side_weight);
}
