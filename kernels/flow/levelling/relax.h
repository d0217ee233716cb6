// flow: water levels between neighbours, against the pull of the water around. Only water that is
// steep enough at the contact line wets a dry texel: steeper at the line's tips, and any in its
// dents, as surface tension has it.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, water) IN(2, float, pull) INOUT(3, float, moved) IN(4, float, wet)
#include "kernels/dialect/slots/slots.h"

#include "kernels/flow/levelling/exchange.h"

// The water that texel `here` takes from a neighbour (or, below 0, gives to it), in whole droplets.
// The neighbour computes the same number.
RG_FN float taken_from(rg_ctx rg, flow_slide_params p, int z, float water, float pressure, int here,
                       int x, int y)
{
    int i = flow_pane_index(p.size, z, x, y);
    float other = water_at(rg, i);
    float above = pressure_above(rg, p, i, other, pressure);
    float giver = above > 0.0f ? other : water;
    float taker = above > 0.0f ? water : other;
    float whole = exchanged(p, above, giver);
    float around = above > 0.0f ? wet_at(rg, here) : wet_at(rg, i);
    float pinned = p.advance * rg_clamp((p.fill - around) * p.steeper, 0.0f, 4.0f);
    whole = taker == 0.0f && giver < pinned ? 0.0f : whole;
    whole = flow_on_pane(p.size, x, y) ? whole : 0.0f;
    return above > 0.0f ? whole : -whole;
}

// Idle: dry texels among dry ones, which stay dry.
#define RG_IDLE_ITEMS 16
RG_GRID_IDLE(flow_relax)
{
    int i = flow_pane_index(p.size, z, x, y);
    int stride = p.size + 2 * FLOW_MARGIN;
    uint wet = rg_float_bits(water_at(rg, i - 1)) | rg_float_bits(water_at(rg, i + count));
    RG_KEPT
    for (int k = 0; k < count; k++)
        wet = wet | rg_float_bits(water_at(rg, i + k)) |
              rg_float_bits(water_at(rg, i + k - stride)) |
              rg_float_bits(water_at(rg, i + k + stride)) | rg_float_bits(moved_at(rg, i + k));
    return wet == 0u;
}

RG_GRID_KERNEL(flow_relax)
{
    int i = flow_pane_index(p.size, z, x, y);
    float water = water_at(rg, i);
    float pressure = pressure_of(p, water) - pull_at(rg, i);
    float across = taken_from(rg, p, z, water, pressure, i, x - 1, y) +
                   taken_from(rg, p, z, water, pressure, i, x + 1, y);
    float down = taken_from(rg, p, z, water, pressure, i, x, y - 1) +
                 taken_from(rg, p, z, water, pressure, i, x, y + 1);
    moved_put(rg, i, water + (across + down));
}
