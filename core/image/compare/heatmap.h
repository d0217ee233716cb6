// Heat maps of where two pictures differ: false colours with a labelled scale beside them.
#ifndef RG_CORE_IMAGE_COMPARE_HEATMAP_H
#define RG_CORE_IMAGE_COMPARE_HEATMAP_H

#include "core/image/picture.h"

// Draws width * height `values` from 0 (black) to `top` (light yellow) in the colours of magma, and
// right of them a scale whose ends are labelled 0 and `top`. Values outside are drawn as the nearer
// end, NaN as `top`. `heat` becomes a picture of 3 channels, made so that its sRGB codes are the
// colours; the caller destroys it. A picture whose sides are below 128 pixels is enlarged, so that
// a value is a square of pixels.
bool rg_heatmap_draw(const float *values, int width, int height, float top,
                     struct rg_picture *heat);

// Puts the largest |A - B| of each pixel's values into width * height floats (infinite where only
// one is finite), and the largest finite one into `max`.
void rg_heatmap_difference(const struct rg_picture *a, const struct rg_picture *b, float *values,
                           float *max);

#endif
