// flow: the movement of water (equation 3 and figure 13). Each texel keeps what it does not give
// and takes what the texels above it give to it.
#include "flow.h"

#define RG_PARAMS flow_params
#define RG_SLOTS  IN(1, float, water) IN(2, float, given) OUT(3, float, moved)
#include "slots.h"

// What the texel at (x, y) divides: nothing in the margin, which gives nothing.
RG_FN flow_parts parts_from(rg_ctx rg, flow_params p, int x, int y)
{
    int i = flow_index(p.size, x, y);
    return flow_divide(p, water_at(rg, i), given_at(rg, i));
}

RG_GRID_KERNEL(flow_move)
{
    int i = flow_index(p.size, x, y);
    flow_parts near_a = parts_from(rg, p, x - p.ax, y - p.ay);
    flow_parts far_a = parts_from(rg, p, x - 2 * p.ax, y - 2 * p.ay);
    flow_parts near_b = parts_from(rg, p, x - p.bx, y - p.by);
    flow_parts far_b = parts_from(rg, p, x - 2 * p.bx, y - 2 * p.by);
    float taken = (near_a.near_a + far_a.far_a) + (near_b.near_b + far_b.far_b);
    moved_put(rg, i, (water_at(rg, i) - given_at(rg, i)) + taken);
}
