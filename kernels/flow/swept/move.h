// flow: water moves, where texels keep directions. Each texel looks at those that may lead to it,
// one and two texels away in each of the eight directions.
#include "kernels/flow/swept/heading.h"

#define RG_PARAMS flow_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, float, given) INOUT(3, float, moved) IN(4, flow_pane, panes) IN(5, uint, heading)
#include "kernels/dialect/slots/slots.h"

// The water that texel i gives to the first, or to the second, texel in a direction.
RG_FN float part_from(rg_ctx rg, flow_params p, flow_pane pane, int i, int eighth, bool is_far)
{
    float given = given_at(rg, i);
    if (given == 0.0f)
        return 0.0f;
    uint heading = heading_at(rg, i);
    flow_parts parts = flow_divide(p, flow_pane_headed(pane, heading), water_at(rg, i), given);
    int from = flow_heading_eighth(heading);
    float a = is_far ? parts.far_a : parts.near_a;
    float b = is_far ? parts.far_b : parts.near_b;
    return from == eighth ? a : ((from + 1) & 7) == eighth ? b : 0.0f;
}

// Idle: texels without a giver in reach, whose water is in `moved` already.
#define RG_IDLE_ITEMS 16
RG_GRID_IDLE(flow_swept_move)
{
    int i = flow_pane_index(p.size, z, x, y);
    uint busy = 0u;
    RG_KEPT
    for (int k = 0; k < count; k++)
        busy = busy | (rg_float_bits(water_at(rg, i + k)) ^ rg_float_bits(moved_at(rg, i + k)));
    for (int row = -2; row <= 2 && busy == 0u; row++) {
        int from = i + row * (p.size + 2 * FLOW_MARGIN) - 2;
        RG_KEPT
        for (int k = 0; k < count + 4; k++)
            busy = busy | rg_float_bits(given_at(rg, from + k));
    }
    return busy == 0u;
}

RG_GRID_KERNEL(flow_swept_move)
{
    int i = flow_pane_index(p.size, z, x, y);
    flow_pane q = panes_at(rg, z);
    float taken = 0.0f;
    for (int e = 0; e < 8; e++) {
        int step = flow_step_y(e) * (p.size + 2 * FLOW_MARGIN) + flow_step_x(e);
        taken = taken + (part_from(rg, p, q, i - step, e, false) +
                         part_from(rg, p, q, i - 2 * step, e, true));
    }
    moved_put(rg, i, (water_at(rg, i) - given_at(rg, i)) + taken);
}
