// Stores colours in an image of RGBA32F.
#define RG_SLOTS      IN(1, rgba, colours) OUT_IMAGE(2, RGBA32F, target)
#define RG_OWN_TEXELS z
#include "tests/kernels/texels/store/body.h"

RG_GRID_KERNEL(test_store_rgba32f)
{
    test_store(rg, p, x, y, z);
}
