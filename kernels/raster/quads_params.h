// The parameters of quads.h, and the layout of its buffer.
#ifndef RG_KERNELS_RASTER_QUADS_PARAMS_H
#define RG_KERNELS_RASTER_QUADS_PARAMS_H

#include "kernels/dialect/lang.h"

// Floats of a quad: centre x and y in clip space; half its length and half its width in the
// target's heights; its angle at the start in radians; the growth of the angle for each 1 of
// `turned`, -1 to 1; depth; a colour.
#define RASTER_QUAD_WORDS 11

RG_STRUCT(raster_quads_params)
{
    float aspect; // the target's width over its height
    float turned; // radians
};
RG_STRUCT_SIZE(raster_quads_params, 2)

#endif
