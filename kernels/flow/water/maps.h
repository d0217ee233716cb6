// Reads the remainder map and the noise map, the slots remainder and noise of the including kernel.
#ifndef RG_KERNELS_FLOW_WATER_MAPS_H
#define RG_KERNELS_FLOW_WATER_MAPS_H

// The entry of the remainder map that is nearest to the water's amount.
RG_FN float remainder_of(rg_ctx rg, flow_params p, float water)
{
    float entry = water * p.remainder_scale + 0.5f;
    return remainder_at(rg, rg_to_int(rg_min(entry, rg_to_float(FLOW_REMAINDER_ENTRIES - 1))));
}

RG_FN float noise_of(rg_ctx rg, flow_params p, float shift, int x, int y)
{
    int nx = flow_noise_index(p.noise_x + shift, p.noise_step, x, p.noise_size);
    int ny = flow_noise_index(p.noise_y, p.noise_step, y, p.noise_size);
    return noise_at(rg, ny * p.noise_size + nx);
}

#endif
