// The parameters of test_rounding.h.
#ifndef RG_KERNELS_TEST_ROUNDING_PARAMS_H
#define RG_KERNELS_TEST_ROUNDING_PARAMS_H

#include "lang.h"

RG_STRUCT(test_rounding_params)
{
    int count; // of each of the three inputs, and of each kind of result
};
RG_STRUCT_SIZE(test_rounding_params, 1)

#endif
