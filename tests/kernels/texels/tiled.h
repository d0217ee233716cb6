// Reads a scene's texture. Elements of `at` are u, v, the layer, and the square of a pixel's width
// in texels of level 0.
#include "tests/kernels/texels/params.h"

#define RG_PARAMS test_texels_params
#define RG_SLOTS  SAMPLED(1, RGBA8, textures, TILED) IN(2, rgba, at) OUT(3, rgba, colours)
#include "kernels/dialect/slots/slots.h"

#include "kernels/scenery/texture.h"

RG_GRID_KERNEL(test_tiled)
{
    rgba at = at_at(rg, x);
    colours_put(rg, x, scenery_texture(rg, at.r, at.g, rg_to_int(at.b), at.a, p.width, p.level));
}
