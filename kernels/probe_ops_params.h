// The parameters of probe_ops.h and probe_builtin.h.
#ifndef RG_KERNELS_PROBE_OPS_PARAMS_H
#define RG_KERNELS_PROBE_OPS_PARAMS_H

#include "lang.h"

RG_STRUCT(probe_params)
{
    int op; // its number in kernels/probe_list.h
};
RG_STRUCT_SIZE(probe_params, 1)

#endif
