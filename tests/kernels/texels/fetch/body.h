// The common part of these files, each of which defines RG_SLOTS: fetches a level of an image to a
// buffer.
#include "tests/kernels/texels/params.h"

#define RG_PARAMS test_texels_params
#include "kernels/dialect/slots/slots.h"

RG_PROC void test_fetch(rg_ctx rg, test_texels_params p, int x, int y, int z)
{
    if (x < source_width(rg, p.level) && y < source_height(rg, p.level))
        colours_put(rg, (z * p.height + y) * p.width + x, source_texel(rg, x, y, z, p.level));
}
