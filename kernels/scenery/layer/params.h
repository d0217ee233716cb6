// The parameters of meet.h, which needs none.
#ifndef RG_KERNELS_SCENERY_LAYER_PARAMS_H
#define RG_KERNELS_SCENERY_LAYER_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(layer_params)
{
    int nothing;
};
RG_STRUCT_SIZE(layer_params, 1)

#endif
