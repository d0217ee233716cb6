// The parameters of far.h.
#ifndef RG_KERNELS_STREAKS_FAR_PARAMS_H
#define RG_KERNELS_STREAKS_FAR_PARAMS_H

#include "kernels/streaks/params.h"

// Slabs in a layer.
#define STREAKS_FAR_PARTS 4

// The light of an atlas' streaks (core/techniques/streaks/far/means.c), for each block of
// neighbours between which pictures are blended: two views, two elevations and two azimuths of the
// light. A blend's mean follows from the means of the 8 corners. Its mean square follows from the
// means of their products, of which 27 differ in how often the upper neighbour along each axis is
// in them. The sky's follow after all blocks, for each two views: 2 means and 3 products.
#define STREAKS_FAR_BLOCK   35  // floats
#define STREAKS_FAR_SQUARES 8   // index of the first product
#define STREAKS_FAR_WIDE    8   // blocks along the azimuth: STREAKS_AZIMUTHS - 1
#define STREAKS_FAR_HIGH    9   // STREAKS_HEIGHTS - 1
#define STREAKS_FAR_BLOCKS  288 // STREAKS_VIEWS - 1 times these
#define STREAKS_FAR_SKY     5   // floats

RG_STRUCT(streaks_far_params)
{
    streaks_params rain;
    int lights;    // as kernels/dialect/draw/draw.h asks for them
    float nearest; // distance at which far rain begins, as the culling prism counts it, and ends
    float farthest;
    float thickness; // of a slab
    float fallen;    // way of the rain since frame 0
    float drops_m3;  // where the density map is white
    int seed;
    int taps; // textures that are read for a light: 2, 4 or 8
};
RG_STRUCT_SIZE(streaks_far_params, 112)

#endif
