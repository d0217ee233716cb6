// Divides the water that texels give, by the slots water and given of the including kernel.
#ifndef RG_KERNELS_FLOW_WATER_TAKEN_H
#define RG_KERNELS_FLOW_WATER_TAKEN_H

// The parts that the texel at (x, y) of pane z gives; 0 in the margin.
RG_FN flow_parts parts_from(rg_ctx rg, flow_params p, flow_pane pane, int z, int x, int y)
{
    int i = flow_pane_index(p.size, z, x, y);
    return flow_divide(p, pane, water_at(rg, i), given_at(rg, i));
}

#endif
