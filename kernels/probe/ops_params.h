// The parameters of ops.h and builtin.h.
#ifndef RG_KERNELS_PROBE_OPS_PARAMS_H
#define RG_KERNELS_PROBE_OPS_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(probe_params)
{
    int op; // its number in kernels/probe/list.h
};
RG_STRUCT_SIZE(probe_params, 1)

#endif
