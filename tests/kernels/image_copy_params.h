// The parameters of image_copy.h.
#ifndef RG_TESTS_KERNELS_IMAGE_COPY_PARAMS_H
#define RG_TESTS_KERNELS_IMAGE_COPY_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(test_image_copy_params)
{
    int layer;
    int level;
};
RG_STRUCT_SIZE(test_image_copy_params, 2)

#endif
