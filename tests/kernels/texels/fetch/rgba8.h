// Fetches the colours of an image of RGBA8.
#define RG_SLOTS IMAGE(1, RGBA8, source) OUT(2, rgba, colours)
#include "tests/kernels/texels/fetch/body.h"

RG_GRID_KERNEL(test_fetch_rgba8)
{
    test_fetch(rg, p, x, y, z);
}
