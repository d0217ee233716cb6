// flow: interpolates a map of the lattice across, for each texel of a row; its readers then
// interpolate down. A run over texels across and cells down.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, cells) OUT(2, float, rows)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_across)
{
    float u = (rg_to_float(x) + 0.5f) / rg_to_float(p.texels_a_cell);
    flow_between b = flow_between_at(p, z, u, rg_to_float(y) + 0.5f);
    rows_put(rg, flow_rows_index(p, z, x, y),
             flow_mix_across(b, cells_at(rg, b.i), cells_at(rg, b.i + 1)));
}
