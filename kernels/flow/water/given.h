// flow: the water that each texel gives away in this step (equation 3, with one predicate for giver
// and taker, so that nothing is lost between them).
#include "kernels/flow/water/water.h"

#define RG_PARAMS flow_params
#define RG_SLOTS                                                                                   \
    IN(1, float, water)                                                                            \
    IN(2, float, remainder) IN(3, float, noise) INOUT(4, float, given) IN(5, flow_pane, panes)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/water/maps.h"

// Idle: texels with too little water to move, which gave nothing before either.
#define RG_IDLE_ITEMS 16
RG_GRID_IDLE(flow_given)
{
    int i = flow_pane_index(p.size, z, x, y);
    uint busy = 0u;
    RG_KEPT
    for (int k = 0; k < count; k++)
        busy = busy | rg_float_bits(given_at(rg, i + k)) |
               (water_at(rg, i + k) > p.move_threshold ? 1u : 0u);
    return busy == 0u;
}

RG_GRID_KERNEL(flow_given)
{
    int i = flow_pane_index(p.size, z, x, y);
    flow_pane pane = panes_at(rg, z);
    float water = water_at(rg, i);
    float noise = noise_of(rg, p, pane.noise_shift, x, y);
    given_put(rg, i, flow_given(p, pane.speed, water, remainder_of(rg, p, water), noise));
}
