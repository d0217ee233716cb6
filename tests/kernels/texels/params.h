// The parameters of kernels that fetch and store texels.
#ifndef RG_TESTS_KERNELS_TEXELS_PARAMS_H
#define RG_TESTS_KERNELS_TEXELS_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(test_texels_params)
{
    int width; // of the level
    int height;
    int level;
};
RG_STRUCT_SIZE(test_texels_params, 3)

#endif
