// flow: water moves (equation 3 and figure 13). Each texel keeps the water that it does not give,
// and takes that which the texels above give to it.
#include "kernels/flow/water/water.h"

#define RG_PARAMS flow_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water) IN(2, float, given) OUT(3, float, moved) IN(4, flow_pane, panes)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/water/taken.h"

RG_GRID_KERNEL(flow_move)
{
    int i = flow_pane_index(p.size, z, x, y);
    flow_pane q = panes_at(rg, z);
    flow_parts near_a = parts_from(rg, p, q, z, x - q.ax, y - q.ay);
    flow_parts far_a = parts_from(rg, p, q, z, x - 2 * q.ax, y - 2 * q.ay);
    flow_parts near_b = parts_from(rg, p, q, z, x - q.bx, y - q.by);
    flow_parts far_b = parts_from(rg, p, q, z, x - 2 * q.bx, y - 2 * q.by);
    float taken = (near_a.near_a + far_a.far_a) + (near_b.near_b + far_b.far_b);
    moved_put(rg, i, (water_at(rg, i) - given_at(rg, i)) + taken);
}
