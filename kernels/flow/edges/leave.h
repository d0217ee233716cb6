// Water leaves a pane over its edges, in whole droplets, by the slots ledger and arriving of the
// including kernel. It goes on to the pane beyond the edge; if there is none it is lost, and the
// ledger counts it.
#ifndef RG_KERNELS_FLOW_EDGES_LEAVE_H
#define RG_KERNELS_FLOW_EDGES_LEAVE_H

// Lets a part that goes to (x, y) leave, if that lies off pane q. Over a corner it leaves by the
// top or bottom edge.
RG_PROC void leave(rg_ctx rg, int size, flow_pane q, int x, int y, float part)
{
    int last = size - 1;
    uint droplets = rg_to_uint(part * FLOW_DROPLETS_PER_UNIT);
    if (droplets == 0u || flow_on_pane(size, x, y))
        return;
    flow_neighbour over = q.right;
    int beyond = x - size;
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
            beyond = y - size;
        }
    }
    if (over.pane == FLOW_NO_PANE) {
        ledger_add(rg, FLOW_LEDGER_DRAINED, droplets);
        return;
    }
    flow_texel to = flow_enter(size, over, along, beyond);
    arriving_add(rg, flow_pane_index(size, over.pane, to.x, to.y), droplets);
}

#endif
