// Fetches the colours of an image of RGBA16F.
#define RG_SLOTS IMAGE(1, RGBA16F, source) OUT(2, rgba, colours)
#include "tests/kernels/texels/fetch/body.h"

RG_GRID_KERNEL(test_fetch_rgba16f)
{
    test_fetch(rg, p, x, y, z);
}
