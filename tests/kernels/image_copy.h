// Copies one level and layer of an image into another image, texel by texel.
#include "tests/kernels/image_copy_params.h"

#define RG_PARAMS     test_image_copy_params
#define RG_SLOTS      IMAGE(1, RGBA32F, source) OUT_IMAGE(2, RGBA32F, target)
#define RG_OWN_TEXELS z
#include "kernels/dialect/slots/slots.h"

RG_GRID_KERNEL(test_image_copy)
{
    if (x < source_width(rg, p.level) && y < source_height(rg, p.level))
        target_store(rg, x, y, z, source_texel(rg, x, y, p.layer, p.level));
}
