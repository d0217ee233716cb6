// flow: counts the water that leaves over the pane's edges, droplet by droplet.
#include "flow.h"

#define RG_PARAMS flow_params
#define RG_SLOTS  IN(1, float, water) IN(2, float, given) ATOMIC(3, uint, ledger)
#include "slots.h"

RG_FN float lost(flow_params p, int x, int y, float part)
{
    return flow_on_pane(p.size, x, y) ? 0.0f : part;
}

// Items (i, side): the two outermost rows (sides 0 to 3) and columns (4 to 7) at each edge, from
// which a step can lead off the pane. A corner belongs to its rows.
RG_GRID_KERNEL(flow_drain)
{
    int across = (y & 1) == 0 ? (y >> 1) & 1 : p.size - 1 - ((y >> 1) & 1);
    bool is_row = y < 4;
    int tx = is_row ? x : across;
    int ty = is_row ? across : x;
    if (!is_row && (x < 2 || x >= p.size - 2))
        return;
    int i = flow_index(p.size, tx, ty);
    flow_parts parts = flow_divide(p, water_at(rg, i), given_at(rg, i));
    float drained = (lost(p, tx + p.ax, ty + p.ay, parts.near_a) +
                     lost(p, tx + 2 * p.ax, ty + 2 * p.ay, parts.far_a)) +
                    (lost(p, tx + p.bx, ty + p.by, parts.near_b) +
                     lost(p, tx + 2 * p.bx, ty + 2 * p.by, parts.far_b));
    if (drained > 0.0f)
        ledger_add(rg, FLOW_LEDGER_DRAINED, rg_to_uint(drained * FLOW_DROPLETS_PER_UNIT));
}
