// The parameters of city.h.
#ifndef RG_KERNELS_SCENERY_CITY_PARAMS_H
#define RG_KERNELS_SCENERY_CITY_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(scenery_city_params)
{
    m4 to_clip;
};
RG_STRUCT_SIZE(scenery_city_params, 16)

// Words of a face in its buffer: x, y, z of four corners, counter-clockwise seen from outside and
// in one plane. A triangle has its last corner twice.
#define SCENERY_FACE_WORDS 12

// What is drawn are blocks of faces: items 32 k and on are the faces of block k, the first one of
// which, and their number, are two words.
#define SCENERY_BLOCK_FACES 32

#endif
