// flow: what leaves each pane over its edges, droplet by droplet: on to the pane beyond the edge,
// or, where there is none, off, which the ledger counts.
#include "kernels/flow/water/water.h"
#include "kernels/flow/water/strip.h"

#define RG_PARAMS flow_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, float, given) ATOMIC(3, uint, ledger) IN(4, flow_pane, panes) ATOMIC(5, uint, arriving)
#include "kernels/dialect/slots/slots.h"

// A part that goes to (x, y) of pane z, if that lies off the pane. What leaves over a corner leaves
// over the row's edge.
RG_PROC void leave(rg_ctx rg, flow_params p, flow_pane q, int x, int y, float part)
{
    int last = p.size - 1;
    uint droplets = rg_to_uint(part * FLOW_DROPLETS_PER_UNIT);
    if (droplets == 0u || flow_on_pane(p.size, x, y))
        return;
    flow_neighbour over = q.right;
    int beyond = x - p.size;
    int along = y;
    if (x < 0) {
        over = q.left;
        beyond = -1 - x;
    }
    if (y < 0 || y > last) {
        over = q.top;
        beyond = -1 - y;
        along = rg_iclamp(x, 0, last);
        if (y > last) {
            over = q.bottom;
            beyond = y - p.size;
        }
    }
    if (over.pane == FLOW_NO_PANE) {
        ledger_add(rg, FLOW_LEDGER_DRAINED, droplets);
        return;
    }
    flow_texel to = flow_enter(p.size, over, along, beyond);
    arriving_add(rg, flow_pane_index(p.size, over.pane, to.x, to.y), droplets);
}

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
    leave(rg, p, q, at.x + q.ax, at.y + q.ay, parts.near_a);
    leave(rg, p, q, at.x + 2 * q.ax, at.y + 2 * q.ay, parts.far_a);
    leave(rg, p, q, at.x + 3 * q.ax, at.y + 3 * q.ay, parts.third_a);
    leave(rg, p, q, at.x + 4 * q.ax, at.y + 4 * q.ay, parts.fourth_a);
    leave(rg, p, q, at.x + q.bx, at.y + q.by, parts.near_b);
    leave(rg, p, q, at.x + 2 * q.bx, at.y + 2 * q.by, parts.far_b);
    leave(rg, p, q, at.x + 3 * q.bx, at.y + 3 * q.by, parts.third_b);
    leave(rg, p, q, at.x + 4 * q.bx, at.y + 4 * q.by, parts.fourth_b);
}
