// The parameters of precise.h.
#ifndef RG_TESTS_KERNELS_PRECISE_PARAMS_H
#define RG_TESTS_KERNELS_PRECISE_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(test_precise_params)
{
    float scale;
    float offset;
    int count;
};
RG_STRUCT_SIZE(test_precise_params, 3)

#endif
