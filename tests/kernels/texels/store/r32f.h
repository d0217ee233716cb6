// Stores colours in an image of R32F.
#define RG_SLOTS      IN(1, rgba, colours) OUT_IMAGE(2, R32F, target)
#define RG_OWN_TEXELS z
#include "tests/kernels/texels/store/body.h"

RG_GRID_KERNEL(test_store_r32f)
{
    test_store(rg, p, x, y, z);
}
