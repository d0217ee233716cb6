// Reads an image of RG11B10F between its texels.
#define RG_SLOTS SAMPLED(1, RG11B10F, source, FILTERED) IN(2, rgba, at) OUT(3, rgba, colours)
#include "tests/kernels/texels/filter/body.h"

RG_GRID_KERNEL(test_filter_rg11b10f)
{
    test_filter(rg, p, x);
}
