// The parameters of raster_streaks.h and raster_drops.h.
#ifndef RG_KERNELS_RASTER_STREAKS_PARAMS_H
#define RG_KERNELS_RASTER_STREAKS_PARAMS_H

#include "vec.h"

RG_STRUCT(raster_drops_params)
{
    int count;
    int seed;
};
RG_STRUCT_SIZE(raster_drops_params, 2)

// The eye is at the origin and looks along z; x points right and y down, in metres.
RG_STRUCT(raster_streaks_params)
{
    int count; // of drops in the buffer
    v3 corner; // of the box of air: least x, y and z
    v3 size;   // of the box
    v3 fallen; // how far the drops have come since the start, in boxes, 0 to 1
    v3 streak; // from a streak's head to its tail
    float radius_m;
    float scale_x; // clip space: x' = scale_x x, y' = scale_y y, z' = depth_scale z + depth_offset,
    float scale_y; // w' = z
    float depth_scale;
    float depth_offset;
    rgba colour; // of a streak, premultiplied
};
RG_STRUCT_SIZE(raster_streaks_params, 22)

#endif
