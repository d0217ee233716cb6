// Reads an image of R16F between its texels.
#define RG_SLOTS SAMPLED(1, R16F, source, FILTERED) IN(2, rgba, at) OUT(3, rgba, colours)
#include "tests/kernels/texels/filter/body.h"

RG_GRID_KERNEL(test_filter_r16f)
{
    test_filter(rg, p, x);
}
