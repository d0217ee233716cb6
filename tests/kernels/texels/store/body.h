// The common part of these files, each of which defines RG_SLOTS: stores colours of a buffer in an
// image.
#include "tests/kernels/texels/params.h"

#define RG_PARAMS test_texels_params
#include "kernels/dialect/slots/slots.h"

RG_PROC void test_store(rg_ctx rg, test_texels_params p, int x, int y, int z)
{
    if (x < p.width && y < p.height)
        target_store(rg, x, y, z, colours_at(rg, (z * p.height + y) * p.width + x));
}
