// The parameters of arithmetic.h.
#ifndef RG_KERNELS_PROBE_ARITHMETIC_PARAMS_H
#define RG_KERNELS_PROBE_ARITHMETIC_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(probe_arithmetic_params)
{
    float factor; // near 1
    float term;   // small
};
RG_STRUCT_SIZE(probe_arithmetic_params, 2)

// Multiplications and additions that an item does.
#define PROBE_ARITHMETIC_OPS 527

#endif
