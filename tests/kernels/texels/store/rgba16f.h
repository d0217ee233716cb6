// Stores colours in an image of RGBA16F.
#define RG_SLOTS      IN(1, rgba, colours) OUT_IMAGE(2, RGBA16F, target)
#define RG_OWN_TEXELS z
#include "tests/kernels/texels/store/body.h"

RG_GRID_KERNEL(test_store_rgba16f)
{
    test_store(rg, p, x, y, z);
}
