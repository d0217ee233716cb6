// The parameters of streaks_city_shade.h.
#ifndef RG_KERNELS_STREAKS_CITY_SHADE_PARAMS_H
#define RG_KERNELS_STREAKS_CITY_SHADE_PARAMS_H

#include "matrix.h"
#include "streaks_sky.h"

RG_STRUCT(streaks_city_shade_params)
{
    m4 from_pixel; // from (pixel x, pixel y, depth, 1) to the world, before division by w
    streaks_sky sky;
    float eye_x, eye_y, eye_z;
    float pixel_m;             // a pixel's width at w = 1, in metres
    float ambient;             // share of the sky's light that lights surfaces
    float glow;                // light of lit windows
    float sun_x, sun_y, sun_z; // towards it, of unit length
    float sun;                 // its light
    int texture_px;
    int last_level;
};
RG_STRUCT_SIZE(streaks_city_shade_params, 36)

#endif
