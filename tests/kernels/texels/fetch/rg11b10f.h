// Fetches the colours of an image of RG11B10F.
#define RG_SLOTS IMAGE(1, RG11B10F, source) OUT(2, rgba, colours)
#include "tests/kernels/texels/fetch/body.h"

RG_GRID_KERNEL(test_fetch_rg11b10f)
{
    test_fetch(rg, p, x, y, z);
}
