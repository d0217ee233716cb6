// The parameters of idle.h.
#ifndef RG_TESTS_KERNELS_IDLE_PARAMS_H
#define RG_TESTS_KERNELS_IDLE_PARAMS_H

#include "kernels/dialect/lang.h"

#define TEST_IDLE_ITEMS 16

RG_STRUCT(test_idle_params)
{
    int width; // items a row
};
RG_STRUCT_SIZE(test_idle_params, 1)

#endif
