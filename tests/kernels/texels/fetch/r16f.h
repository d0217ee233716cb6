// Fetches the colours of an image of R16F.
#define RG_SLOTS IMAGE(1, R16F, source) OUT(2, rgba, colours)
#include "tests/kernels/texels/fetch/body.h"

RG_GRID_KERNEL(test_fetch_r16f)
{
    test_fetch(rg, p, x, y, z);
}
