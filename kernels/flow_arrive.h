// flow: takes in what came over the edges from neighbouring panes. After the movement.
#include "flow_strip.h"

#define RG_PARAMS flow_params
#define RG_SLOTS  INOUT(1, float, water) INOUT(2, uint, arriving)
#include "slots.h"

RG_GRID_KERNEL(flow_arrive)
{
    flow_texel at = flow_strip_texel(p.size, x, y);
    if (at.x < 0)
        return;
    int i = flow_pane_index(p.size, z, at.x, at.y);
    uint droplets = arriving_at(rg, i);
    if (droplets == 0u)
        return;
    water_put(rg, i, water_at(rg, i) + rg_to_float(droplets) * FLOW_DROPLET);
    arriving_put(rg, i, 0u);
}
