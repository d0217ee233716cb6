// flow: takes in the water that came over the edges from neighbouring panes, after the movement.
// Water gathers at an edge to which both panes lead it. Above FLOW_EDGE_HOLDS it drips off, so that
// amounts stay small enough for a float to count every droplet.
#include "kernels/flow/edges/strip.h"

#define RG_PARAMS flow_params
#define RG_SLOTS  INOUT(1, float, water) INOUT(2, uint, arriving) ATOMIC(3, uint, ledger)
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(flow_arrive)
{
    flow_texel at = flow_strip_texel(p.size, x, y);
    if (at.x < 0)
        return;
    int i = flow_pane_index(p.size, z, at.x, at.y);
    uint droplets = arriving_at(rg, i);
    if (droplets == 0u)
        return;
    float water = water_at(rg, i);
    uint room = rg_to_uint(rg_max(FLOW_EDGE_HOLDS - water, 0.0f) * FLOW_DROPLETS_PER_UNIT);
    uint taken = droplets < room ? droplets : room;
    water_put(rg, i, water + rg_to_float(taken) * FLOW_DROPLET);
    arriving_put(rg, i, 0u);
    if (taken < droplets)
        ledger_add(rg, FLOW_LEDGER_DRAINED, droplets - taken);
}
