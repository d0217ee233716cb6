// The parameters of splat.h: one drop that lands on a pane.
#ifndef RG_KERNELS_FLOW_WATER_SPLAT_PARAMS_H
#define RG_KERNELS_FLOW_WATER_SPLAT_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(flow_splat_params)
{
    int size;                 // texels along a side of the pane
    int pane;                 // which one
    float centre_x, centre_y; // in texels
    float radius_px;
    float height;   // at the centre, in units of water
    float capacity; // the most water that a texel may hold
};
RG_STRUCT_SIZE(flow_splat_params, 7)

#endif
