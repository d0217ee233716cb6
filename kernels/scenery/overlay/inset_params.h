// The parameters of inset.h.
#ifndef RG_KERNELS_SCENERY_OVERLAY_INSET_PARAMS_H
#define RG_KERNELS_SCENERY_OVERLAY_INSET_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(scenery_inset_params)
{
    int x0, y0, x1, y1;   // the pixels x0 <= x < x1, y0 <= y < y1
    float u0, v0, u1, v1; // the part of the map that they show, each within 0 to 1
    int layer;
    float near_depth; // white
    float far_depth;  // black
};
RG_STRUCT_SIZE(scenery_inset_params, 11)

#endif
