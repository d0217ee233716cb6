// Fetches the colours of an image of R32F.
#define RG_SLOTS IMAGE(1, R32F, source) OUT(2, rgba, colours)
#include "tests/kernels/texels/fetch/body.h"

RG_GRID_KERNEL(test_fetch_r32f)
{
    test_fetch(rg, p, x, y, z);
}
