// flow: the share of the glass around a texel that is wet, weighted by nearness: 1/2 at a straight
// contact line, more in its dents, less at its tips.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, wet_rows) OUT(2, float, wet)
#include "kernels/dialect/slots/slots.h"

// Rows beyond the edge are the margin's, which is dry.
RG_FN float both_sides(rg_ctx rg, flow_slide_params p, int z, int x, int y, int away)
{
    int side = away * p.apart;
    int above = flow_pane_index(p.size, z, x, rg_imax(y - side, -1));
    int below = flow_pane_index(p.size, z, x, rg_imin(y + side, p.size));
    return (wet_rows_at(rg, above) + wet_rows_at(rg, below)) * flow_near_weight(p, away);
}

RG_GRID_KERNEL(flow_wet)
{
    int i = flow_pane_index(p.size, z, x, y);
    float sum = wet_rows_at(rg, i) * flow_near_weight(p, 0);
    sum = sum + both_sides(rg, p, z, x, y, 1) + both_sides(rg, p, z, x, y, 2);
    sum = sum + both_sides(rg, p, z, x, y, 3) + both_sides(rg, p, z, x, y, 4);
    wet_put(rg, i, sum * p.near_scale);
}
