// The parameters of city.h.
#ifndef RG_KERNELS_SCENERY_CITY_PARAMS_H
#define RG_KERNELS_SCENERY_CITY_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(scenery_city_params)
{
    m4 to_clip;
};
RG_STRUCT_SIZE(scenery_city_params, 16)

// Words of a face in its buffer: x, y, z of four corners in one plane, counter-clockwise seen from
// outside. A triangle has its last corner twice.
#define SCENERY_FACE_WORDS 12

// Faces are drawn in blocks: items from 32 k on are the faces of block k. A block is two words: its
// first face, and its number of faces.
#define SCENERY_BLOCK_FACES 32

#endif
