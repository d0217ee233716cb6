// Fetches the colours of an image of D32F.
#define RG_SLOTS IMAGE(1, D32F, source) OUT(2, rgba, colours)
#include "tests/kernels/texels/fetch/body.h"

RG_GRID_KERNEL(test_fetch_d32f)
{
    test_fetch(rg, p, x, y, z);
}
