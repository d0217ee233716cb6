// flow: water levels between neighbours, against the pull of the water around. Up to the height
// p.bent its pressure grows with the square of the height, which gives drops the profile of a half
// ellipse; above, linearly. Only water that is steep enough at the contact line wets a dry texel.
#include "kernels/flow/sliding/params.h"

#define RG_PARAMS flow_slide_params
#define RG_SLOTS  IN(1, float, water) IN(2, float, pull) INOUT(3, float, moved)
#include "kernels/dialect/slots/slots.h"

RG_FN float pressure_of(flow_slide_params p, float water)
{
    float square = water * water * (0.5f / p.bent);
    return water < p.bent ? square : water - 0.5f * p.bent;
}

// The water that a texel takes from a neighbour (or, below 0, gives to it), in whole droplets. The
// neighbour computes the same number.
RG_FN float taken_from(rg_ctx rg, flow_slide_params p, int z, float water, float pressure, int x,
                       int y)
{
    int i = flow_pane_index(p.size, z, x, y);
    float other = water_at(rg, i);
    float above = pressure_of(p, other) - pull_at(rg, i) - pressure;
    float giver = above > 0.0f ? other : water;
    float taker = above > 0.0f ? water : other;
    float layer = rg_clamp(giver, p.least_layer, p.most_layer);
    float part = rg_min(rg_abs(above) * p.levelling * layer, giver * FLOW_MOST_GIVEN);
    float whole = flow_whole_droplets(part);
    whole = taker == 0.0f && giver < p.advance ? 0.0f : whole;
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
    float across = taken_from(rg, p, z, water, pressure, x - 1, y) +
                   taken_from(rg, p, z, water, pressure, x + 1, y);
    float down = taken_from(rg, p, z, water, pressure, x, y - 1) +
                 taken_from(rg, p, z, water, pressure, x, y + 1);
    moved_put(rg, i, water + (across + down));
}
