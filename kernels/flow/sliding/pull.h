// flow: the pull on each texel's water of the water around it, which keeps drops together.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, close) OUT(2, float, pull)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_pull)
{
    flow_between b = flow_between_of(p, z, x, y);
    int below = b.i + flow_lattice_stride(p);
    float around = flow_mix(b, close_at(rg, b.i), close_at(rg, b.i + 1), close_at(rg, below),
                            close_at(rg, below + 1));
    pull_put(rg, flow_pane_index(p.size, z, x, y), around * p.cohesion);
}
