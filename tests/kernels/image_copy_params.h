// The parameters of image_copy.h.
#ifndef RG_KERNELS_TEST_IMAGE_COPY_PARAMS_H
#define RG_KERNELS_TEST_IMAGE_COPY_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(test_image_copy_params)
{
    int layer;
    int level;
};
RG_STRUCT_SIZE(test_image_copy_params, 2)

#endif
