// flow: each texel's direction in this step, and the water that it gives, where texels keep
// directions.
#include "kernels/flow/swept/heading.h"

#define RG_PARAMS flow_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, float, remainder)                                                                        \
    IN(3, float, noise)                                                                            \
    INOUT(4, float, given) IN(5, flow_pane, panes) IN(6, uint, kept) INOUT(7, uint, heading)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/water/maps.h"

// The sum of the directions of those that moved by themselves in the step before, of a texel and
// its eight neighbours, and their number.
RG_STRUCT(flow_movers)
{
    float x;
    float y;
    float count;
};

RG_FN flow_movers and_mover(rg_ctx rg, flow_movers others, int i)
{
    uint heading = kept_at(rg, i);
    flow_way way = flow_heading_way(heading);
    float moves = (heading & FLOW_HEADING_MOVES) != 0u ? 1.0f : 0.0f;
    flow_movers m;
    m.x = others.x + way.x * moves;
    m.y = others.y + way.y * moves;
    m.count = others.count + moves;
    return m;
}

RG_FN flow_movers and_row(rg_ctx rg, flow_movers others, int i)
{
    return and_mover(rg, and_mover(rg, and_mover(rg, others, i - 1), i), i + 1);
}

RG_FN flow_movers movers_around(rg_ctx rg, int size, int i)
{
    int stride = size + 2 * FLOW_MARGIN;
    flow_movers none;
    none.x = 0.0f;
    none.y = 0.0f;
    none.count = 0.0f;
    return and_row(rg, and_row(rg, and_row(rg, none, i - stride), i), i + stride);
}

// Down the pane, turned by the share `sweep` towards the mean of the neighbours' directions; down
// if the two cancel out.
RG_FN uint heading_by(flow_params p, flow_pane q, flow_movers m)
{
    float down_x = q.speed > 0.0f ? -q.t.y / q.speed : 0.0f;
    float down_y = q.speed > 0.0f ? -q.b.y / q.speed : 1.0f;
    float sweep = m.count > 0.0f ? p.sweep : 0.0f;
    float x = down_x * (1.0f - sweep) + m.x / rg_max(m.count, 1.0f) * sweep;
    float y = down_y * (1.0f - sweep) + m.y / rg_max(m.count, 1.0f) * sweep;
    bool cancels = x * x + y * y < 1e-4f;
    return flow_heading_of(cancels ? down_x : x, cancels ? down_y : y);
}

// Idle: dry texels that gave nothing before.
#define RG_IDLE_ITEMS 16
RG_GRID_IDLE(flow_swept_given)
{
    int i = flow_pane_index(p.size, z, x, y);
    uint busy = 0u;
    RG_KEPT
    for (int k = 0; k < count; k++)
        busy = busy | rg_float_bits(water_at(rg, i + k)) | rg_float_bits(given_at(rg, i + k)) |
               heading_at(rg, i + k);
    return busy == 0u;
}

RG_GRID_KERNEL(flow_swept_given)
{
    int i = flow_pane_index(p.size, z, x, y);
    flow_pane q = panes_at(rg, z);
    float water = water_at(rg, i);
    flow_movers m = movers_around(rg, p.size, i);
    float own = flow_given(p, q.speed, water, remainder_of(rg, p, water),
                           noise_of(rg, p, q.noise_shift, x, y));
    float swept = m.count > 0.0f ? flow_whole_droplets(water * p.sweep * q.speed) : 0.0f;
    float given = rg_max(own, swept);
    uint heading = heading_by(p, q, m) | (own > 0.0f ? FLOW_HEADING_MOVES : 0u);
    given_put(rg, i, given);
    heading_put(rg, i, given > 0.0f ? heading : 0u);
}
