// Reads an image of RGBA8 between its texels.
#define RG_SLOTS SAMPLED(1, RGBA8, source, FILTERED) IN(2, rgba, at) OUT(3, rgba, colours)
#include "tests/kernels/texels/filter/body.h"

RG_GRID_KERNEL(test_filter_rgba8)
{
    test_filter(rg, p, x);
}
