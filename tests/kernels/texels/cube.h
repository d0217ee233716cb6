// Reads an environment's light. Elements of `at` are a direction and the level.
#include "tests/kernels/texels/params.h"

#define RG_PARAMS test_texels_params
#define RG_SLOTS  SAMPLED(1, RG11B10F, environment, CUBE) IN(2, rgba, at) OUT(3, rgba, colours)
#include "kernels/dialect/slots/slots.h"

#include "kernels/dialect/image/cube_light.h"

RG_GRID_KERNEL(test_cube)
{
    rgba at = at_at(rg, x);
    int level = rg_to_int(at.a);
    v3 light = light_from(rg, v3_make(at.r, at.g, at.b), level, rg_imax(p.width >> level, 1));
    colours_put(rg, x, rg_rgba(light.x, light.y, light.z, 0.0f));
}
