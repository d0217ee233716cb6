// flow: water levels within a drop between texels that are p.reach apart, 2 or 4, if they and all
// between them hold more than a film. It so levels as fast as many runs between neighbours would.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, water) IN(2, float, pull) INOUT(3, float, moved)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/levelling/exchange.h"

// The least water from texel `i` on, up to the one p.reach steps away.
RG_FN float least_between(rg_ctx rg, flow_slide_params p, int i, int step)
{
    float near = water_at(rg, i + step * (p.reach / 4));
    float middle = water_at(rg, i + step * (p.reach / 2));
    float far = water_at(rg, i + step * (p.reach - p.reach / 4));
    return rg_min(rg_min(near, middle), rg_min(far, water_at(rg, i + step * p.reach)));
}

// The water that texel `here` takes from the one p.reach steps away, in whole droplets.
RG_FN float taken_from(rg_ctx rg, flow_slide_params p, float water, float pressure, int here,
                       int step)
{
    int i = here + step * p.reach;
    float other = water_at(rg, i);
    float above = pressure_above(rg, p, i, other, pressure);
    float whole = exchanged(p, above, above > 0.0f ? other : water);
    whole = rg_min(water, least_between(rg, p, here, step)) > p.joined ? whole : 0.0f;
    return above > 0.0f ? whole : -whole;
}

// Idle: dry texels, which stay dry.
#define RG_IDLE_ITEMS 16
RG_GRID_IDLE(flow_relax_far)
{
    int i = flow_pane_index(p.size, z, x, y);
    uint wet = 0u;
    RG_KEPT
    for (int k = 0; k < count; k++)
        wet = wet | rg_float_bits(water_at(rg, i + k)) | rg_float_bits(moved_at(rg, i + k));
    return wet == 0u;
}

RG_GRID_KERNEL(flow_relax_far)
{
    int i = flow_pane_index(p.size, z, x, y);
    int stride = p.size + 2 * FLOW_MARGIN;
    float water = water_at(rg, i);
    float pressure = pressure_of(p, water) - pull_at(rg, i);
    float across =
        taken_from(rg, p, water, pressure, i, -1) + taken_from(rg, p, water, pressure, i, 1);
    float down = taken_from(rg, p, water, pressure, i, -stride) +
                 taken_from(rg, p, water, pressure, i, stride);
    moved_put(rg, i, water + (across + down));
}
