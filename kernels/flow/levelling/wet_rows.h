// flow: how much of the glass around a texel is wet, along its row; wet_columns.h goes on down
// columns.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, water) OUT(2, float, wet_rows)
#include "kernels/dialect/slots/slots.h"

// 1 for a wet texel, less for a film, 0 for a dry one or one beyond the edge.
RG_FN float wet_at_side(rg_ctx rg, flow_slide_params p, int i, int x, int side)
{
    float wet = rg_min(water_at(rg, i + side) * p.wet_per_height, 1.0f);
    return x + side >= 0 && x + side < p.size ? wet : 0.0f;
}

RG_FN float both_sides(rg_ctx rg, flow_slide_params p, int i, int x, int away)
{
    int side = away * p.apart;
    float sum = wet_at_side(rg, p, i, x, -side) + wet_at_side(rg, p, i, x, side);
    return sum * flow_near_weight(p, away);
}

// Written out, because compilers for processors vectorise over items only without a loop.
RG_GRID_KERNEL(flow_wet_rows)
{
    int i = flow_pane_index(p.size, z, x, y);
    float sum = wet_at_side(rg, p, i, x, 0) * flow_near_weight(p, 0);
    sum = sum + both_sides(rg, p, i, x, 1) + both_sides(rg, p, i, x, 2);
    sum = sum + both_sides(rg, p, i, x, 3) + both_sides(rg, p, i, x, 4);
    wet_rows_put(rg, i, sum);
}
