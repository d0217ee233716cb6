// The parameters of triangles.h.
#ifndef RG_TESTS_KERNELS_TRIANGLES_PARAMS_H
#define RG_TESTS_KERNELS_TRIANGLES_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(test_triangles_params)
{
    int layer; // of the image of depth
    int level;
};
RG_STRUCT_SIZE(test_triangles_params, 2)

#endif
