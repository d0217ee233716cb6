// The parameters of plate.h.
#ifndef RG_KERNELS_SCENERY_OVERLAY_PLATE_PARAMS_H
#define RG_KERNELS_SCENERY_OVERLAY_PLATE_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(scenery_plate_params)
{
    m4 to_clip; // from the world
    // In the world: the corner of the map's first texel, the way from there to the end of its first
    // row, and to its last row.
    float corner_x, corner_y, corner_z;
    float across_x, across_y, across_z;
    float down_x, down_y, down_z;
    float white_at; // the map's value that is drawn white
    float black_at; // and black
};
RG_STRUCT_SIZE(scenery_plate_params, 27)

#endif
