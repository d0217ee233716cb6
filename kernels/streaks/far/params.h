// The parameters of far.h.
#ifndef RG_KERNELS_STREAKS_FAR_PARAMS_H
#define RG_KERNELS_STREAKS_FAR_PARAMS_H

#include "kernels/streaks/params.h"

// Slabs a layer.
#define STREAKS_FAR_PARTS 4

// What an atlas' streaks add, of the sky and of each direction of light, for each view: so many
// figures each, which are the mean, the variance, and how alike the picture is to that of the next
// azimuth, elevation and view: their covariance, as a share of the mean of their variances.
#define STREAKS_FAR_MEANS   91 // 1 + STREAKS_COLUMNS
#define STREAKS_FAR_FIGURES 5

RG_STRUCT(streaks_far_params)
{
    streaks_params rain;
    int lights;    // as kernels/dialect/draw/draw.h asks for them
    float nearest; // where it begins, as the culling prism counts distances, and where it ends
    float farthest;
    float thickness; // of a slab
    float fallen;    // how far the rain has come since frame 0
    float drops_m3;  // where the density map is white
    int seed;
    int taps; // textures that are read for a light: 2, 4 or 8
};
RG_STRUCT_SIZE(streaks_far_params, 108)

#endif
