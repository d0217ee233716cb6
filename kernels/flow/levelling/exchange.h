// What two texels exchange as water levels, by the slots water and pull of the including kernel.
#ifndef RG_KERNELS_FLOW_LEVELLING_EXCHANGE_H
#define RG_KERNELS_FLOW_LEVELLING_EXCHANGE_H

// Up to the height p.bent pressure grows with the square of the height, which gives drops the
// profile of a half ellipse; above, linearly.
RG_FN float pressure_of(flow_slide_params p, float water)
{
    float square = water * water * (0.5f / p.bent);
    return water < p.bent ? square : water - 0.5f * p.bent;
}

// How much more pressure, less the pull, texel `i` has than `here`.
RG_FN float pressure_above(rg_ctx rg, flow_slide_params p, int i, float other, float pressure)
{
    return pressure_of(p, other) - pull_at(rg, i) - pressure;
}

// What the one with more pressure gives, in whole droplets.
RG_FN float exchanged(flow_slide_params p, float above, float giver)
{
    float layer = rg_clamp(giver, p.least_layer, p.most_layer);
    float part = rg_min(rg_abs(above) * p.levelling * layer, giver * FLOW_MOST_GIVEN);
    return flow_whole_droplets(part);
}

#endif
