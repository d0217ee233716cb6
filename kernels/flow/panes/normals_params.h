// The parameters of normals.h.
#ifndef RG_KERNELS_FLOW_PANES_NORMALS_PARAMS_H
#define RG_KERNELS_FLOW_PANES_NORMALS_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(flow_normals_params)
{
    int size;               // texels along a side of a pane
    float slope_per_height; // slope of the water for a difference of 1 over two texels
    float wet_per_height;   // wetness a unit of water, until it is 1
};
RG_STRUCT_SIZE(flow_normals_params, 3)

#endif
