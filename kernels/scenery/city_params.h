// The parameters of city.h.
#ifndef RG_KERNELS_SCENERY_CITY_PARAMS_H
#define RG_KERNELS_SCENERY_CITY_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(streaks_city_params)
{
    m4 to_clip;
};
RG_STRUCT_SIZE(streaks_city_params, 16)

// Words of a face in its buffer: x, y, z of four corners, counter-clockwise seen from outside and
// in one plane. A triangle has its last corner twice.
#define STREAKS_FACE_WORDS 12

// What is drawn are blocks of faces: items 32 k and on are the faces of block k, the first one of
// which, and their number, are two words.
#define STREAKS_BLOCK_FACES 32

#endif
