// flow: water leaves each pane over its edges.
#include "kernels/flow/water/water.h"
#include "kernels/flow/edges/strip.h"

#define RG_PARAMS flow_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, float, given) ATOMIC(3, uint, ledger) IN(4, flow_pane, panes) ATOMIC(5, uint, arriving)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/edges/leave.h"

RG_GRID_KERNEL(flow_drain)
{
    flow_texel at = flow_strip_texel(p.size, x, y);
    if (at.x < 0)
        return;
    int i = flow_pane_index(p.size, z, at.x, at.y);
    float given = given_at(rg, i);
    if (given == 0.0f)
        return;
    flow_pane q = panes_at(rg, z);
    flow_parts parts = flow_divide(p, q, water_at(rg, i), given);
    leave(rg, p.size, q, at.x + q.ax, at.y + q.ay, parts.near_a);
    leave(rg, p.size, q, at.x + 2 * q.ax, at.y + 2 * q.ay, parts.far_a);
    leave(rg, p.size, q, at.x + 3 * q.ax, at.y + 3 * q.ay, parts.third_a);
    leave(rg, p.size, q, at.x + 4 * q.ax, at.y + 4 * q.ay, parts.fourth_a);
    leave(rg, p.size, q, at.x + q.bx, at.y + q.by, parts.near_b);
    leave(rg, p.size, q, at.x + 2 * q.bx, at.y + 2 * q.by, parts.far_b);
    leave(rg, p.size, q, at.x + 3 * q.bx, at.y + 3 * q.by, parts.third_b);
    leave(rg, p.size, q, at.x + 4 * q.bx, at.y + 4 * q.by, parts.fourth_b);
}
