// flow: the water around each texel pulls at the texel's water, which keeps drops together.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, close_rows) OUT(2, float, pull) IN(3, float, wet)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_pull)
{
    flow_rows r = flow_rows_of(p, z, x, y);
    float around = flow_mix_down(r, close_rows_at(rg, r.above), close_rows_at(rg, r.below));
    pull_put(rg, flow_pane_index(p.size, z, x, y),
             around * p.cohesion + wet_at(rg, flow_pane_index(p.size, z, x, y)) * p.tension);
}
