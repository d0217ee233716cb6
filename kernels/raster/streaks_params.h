// The parameters of streaks.h and drops.h.
#ifndef RG_KERNELS_RASTER_STREAKS_PARAMS_H
#define RG_KERNELS_RASTER_STREAKS_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(raster_drops_params)
{
    int count;
    int seed;
};
RG_STRUCT_SIZE(raster_drops_params, 2)

// The eye is at the origin and looks along z; x points right and y down, in metres.
RG_STRUCT(raster_streaks_params)
{
    int count;                          // of drops in the buffer
    float corner_x, corner_y, corner_z; // of the box of air: least x, y and z
    float size_x, size_y, size_z;       // of the box
    float fallen_x, fallen_y, fallen_z; // way of the drops so far, in boxes, 0 to 1
    float streak_x, streak_y, streak_z; // from a streak's head to its tail
    float radius_m;
    float scale_x; // clip space: x' = scale_x x, y' = scale_y y, z' = depth_scale z + depth_offset,
    float scale_y; // w' = z
    float depth_scale;
    float depth_offset;
    float light, opacity; // of a streak; light is premultiplied
};
RG_STRUCT_SIZE(raster_streaks_params, 20)

#endif
