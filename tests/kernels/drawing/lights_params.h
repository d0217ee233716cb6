// The parameters of lights.h, and its lights.
#ifndef RG_TESTS_KERNELS_LIGHTS_PARAMS_H
#define RG_TESTS_KERNELS_LIGHTS_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(test_lights_params)
{
    int lights;
    int first;        // of the lights in the buffer
    int plain;        // 1: colours are the sum of the lights
    float px_to_unit; // from pixels to the lights' units
};
RG_STRUCT_SIZE(test_lights_params, 4)

#define TEST_LIGHT_POINT 1
#define TEST_LIGHT_SUN   2

// A light of 32 words, as in techniques' programs.
RG_STRUCT(test_light)
{
    int kind;
    v3 at; // a point's place, or the way to a sun
    rgba colour;
    int layer; // of the maps; -1: none
    float bias, reach;
    int spare0, spare1, spare2, spare3, spare4;
    m4 to_map;
};
RG_STRUCT_SIZE(test_light, 32)

#endif
