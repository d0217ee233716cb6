// The parameters of kernels that read an image between its texels.
#ifndef RG_TESTS_KERNELS_TEXELS_FILTER_PARAMS_H
#define RG_TESTS_KERNELS_TEXELS_FILTER_PARAMS_H

#include "kernels/dialect/lang.h"

#define TEST_FILTER_NEAREST   0
#define TEST_FILTER_LINEAR    1
#define TEST_FILTER_TRILINEAR 2
#define TEST_FILTERS          3

RG_STRUCT(test_filter_params)
{
    int filtering;
};
RG_STRUCT_SIZE(test_filter_params, 1)

#endif
