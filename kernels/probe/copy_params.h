// The parameters of copy.h.
#ifndef RG_KERNELS_PROBE_COPY_PARAMS_H
#define RG_KERNELS_PROBE_COPY_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(probe_copy_params)
{
    int width;
    int height;
    uint salt;
};
RG_STRUCT_SIZE(probe_copy_params, 3)

#endif
