// The parameters of city_shade.h.
#ifndef RG_KERNELS_SCENERY_CITY_SHADE_PARAMS_H
#define RG_KERNELS_SCENERY_CITY_SHADE_PARAMS_H

#include "kernels/dialect/matrix.h"
#include "kernels/scenery/sky.h"

RG_STRUCT(scenery_city_shade_params)
{
    m4 from_pixel; // from (pixel x, pixel y, depth, 1) to the world, before division by w
    scenery_sky sky;
    float eye_x, eye_y, eye_z;
    float pixel_m; // a pixel's width at w = 1, in metres
    float ambient; // share of the zenith's light for surfaces that see the whole sky
    float bounced; // share of the horizon's light for surfaces that see no sky
    float glow;    // light of lit windows and lamps
    float wet;     // 0 to 1: how wet the ground is
    int texture_px;
    int last_level;
    int lights;
    int nothing; // makes whole rows of four
};
RG_STRUCT_SIZE(scenery_city_shade_params, 36)

#endif
