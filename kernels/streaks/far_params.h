// The parameters of far.h.
#ifndef RG_KERNELS_STREAKS_FAR_PARAMS_H
#define RG_KERNELS_STREAKS_FAR_PARAMS_H

#include "kernels/dialect/matrix.h"

// Cells of the pattern along the fall, after which it begins anew; a power of 2.
#define STREAKS_FAR_ROWS 65536u

RG_STRUCT(streaks_far_params)
{
    m4 to_clip; // from the rain frame
    m4 rays;    // (px, py, 1) to the ray through a pixel's centre, in the rain frame
    float eye_x, eye_y, eye_s;
    float nearest;     // distance of the first layer, across the fall
    float thickness;   // of a layer
    float fallen;      // how far the rain has come since frame 0
    float cell_length; // of the pattern, along the fall
    float columns;     // of the pattern around the observer, a layer at `nearest`
    float opacity;     // a layer's mean
    float contrast;    // of the pattern: 0 none, 1 from nothing to twice the mean
    float r, g, b;     // light of what is opaque
    int seed;
};
RG_STRUCT_SIZE(streaks_far_params, 46)

#endif
