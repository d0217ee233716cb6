// The parameters of quads.h.
#ifndef RG_TESTS_KERNELS_QUADS_PARAMS_H
#define RG_TESTS_KERNELS_QUADS_PARAMS_H

#include "kernels/dialect/lang.h"

#define TEST_QUAD_WORDS 20 // floats a quad: x, y, z, w of four corners, then a colour

RG_STRUCT(test_quads_params)
{
    float gradient; // the change of a colour a pixel: fragments depend on their place
    float slope_x;  // the change of depth a pixel
    float slope_y;
};
RG_STRUCT_SIZE(test_quads_params, 3)

#endif
