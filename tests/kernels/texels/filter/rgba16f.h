// Reads an image of RGBA16F between its texels.
#define RG_SLOTS SAMPLED(1, RGBA16F, source, FILTERED) IN(2, rgba, at) OUT(3, rgba, colours)
#include "tests/kernels/texels/filter/body.h"

RG_GRID_KERNEL(test_filter_rgba16f)
{
    test_filter(rg, p, x);
}
