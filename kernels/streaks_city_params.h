// The parameters of streaks_city.h.
#ifndef RG_KERNELS_STREAKS_CITY_PARAMS_H
#define RG_KERNELS_STREAKS_CITY_PARAMS_H

#include "matrix.h"

RG_STRUCT(streaks_city_params)
{
    m4 to_clip;
};
RG_STRUCT_SIZE(streaks_city_params, 16)

// Words of a face in its buffer: x, y, z of four corners, counter-clockwise seen from outside and
// in one plane. A triangle has its last corner twice.
#define STREAKS_FACE_WORDS 12

#endif
