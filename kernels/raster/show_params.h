// The parameters of show_rgba8.h and show_rgba32f.h.
#ifndef RG_KERNELS_RASTER_SHOW_PARAMS_H
#define RG_KERNELS_RASTER_SHOW_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(raster_show_params)
{
    int layer; // of both images
};
RG_STRUCT_SIZE(raster_show_params, 1)

#endif
