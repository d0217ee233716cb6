// The parameters of scenery_lights.h.
#ifndef RG_TESTS_KERNELS_SCENERY_LIGHTS_PARAMS_H
#define RG_TESTS_KERNELS_SCENERY_LIGHTS_PARAMS_H

#include "kernels/dialect/vec.h"

RG_STRUCT(test_scenery_lights_params)
{
    int points;
};
RG_STRUCT_SIZE(test_scenery_lights_params, 1)

// The effect of a light at a point.
RG_STRUCT(test_streaks_lit)
{
    v3 to_light;
    float share;
    float unshadowed;
    float soft;
    float surface; // soft, for a floor at the point
};
RG_STRUCT_SIZE(test_streaks_lit, 7)

#endif
