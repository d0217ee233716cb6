// The parameters of rough.h.
#ifndef RG_KERNELS_PROBE_ROUGH_PARAMS_H
#define RG_KERNELS_PROBE_ROUGH_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(probe_rough_params)
{
    int roots; // of the first operand; 0: quotients
};
RG_STRUCT_SIZE(probe_rough_params, 1)

#endif
