// The parameters of shower's pictures.
#ifndef RG_KERNELS_SHOWER_VIEW_PARAMS_H
#define RG_KERNELS_SHOWER_VIEW_PARAMS_H

#include "kernels/shower/params.h"

RG_STRUCT(shower_view_params)
{
    m4 to_clip; // from the world
    shower_params rain;
    float half_width, half_height; // of the target, in pixels
    float focal_px;                // pixels per metre at a distance of one
    float opacity;                 // of a drop as wide as a pixel or wider
    float mean;                    // of the drop's texture, 0 to 1
    float r, g, b;                 // light of an opaque drop
};
RG_STRUCT_SIZE(shower_view_params, 88)

#endif
