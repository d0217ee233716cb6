// The light from any direction, from the slot of the program that includes this file:
//   SAMPLED(n, RG11B10F, environment, CUBE)
#ifndef RG_KERNELS_DIALECT_IMAGE_CUBE_LIGHT_H
#define RG_KERNELS_DIALECT_IMAGE_CUBE_LIGHT_H

#include "kernels/dialect/image/cube.h"

// The environment's light from a direction of any length but zero, interpolated between four texels
// of a level, which has `size` texels along a face. The outermost texels of a face have their
// centres on the cube's edges (core/scene/environment/cube.h), so that light is the same on both
// sides of an edge. A place on a face always lies between texels' centres, so that the bounds
// checks of filter.h are left out. It pays, because half of all that is drawn is light from here.
#if RG_NATIVE_SAMPLERS

// The driver has the outermost texels' centres half a texel inside the edges, so the components
// along a face shrink by that much, and no filter reaches beyond the face.
RG_FN v3 light_from(rg_ctx rg, v3 d, int level, int size)
{
    float major = rg_max(rg_abs(d.x), rg_max(rg_abs(d.y), rg_abs(d.z)));
    float inside = rg_to_float(size - 1) / rg_to_float(size);
    vec3 to =
        vec3(rg_abs(d.x) == major ? d.x : d.x * inside, rg_abs(d.y) == major ? d.y : d.y * inside,
             rg_abs(d.z) == major ? d.z : d.z * inside);
    vec4 t = textureLod(environment_cube, to, rg_to_float(level));
    return v3_make(t.x, t.y, t.z);
}

#else

RG_FN v3 light_from(rg_ctx rg, v3 d, int level, int size)
{
    cube_point c = cube_locate(d, size - 1);
    int x = cube_texel(c.x, size);
    int y = cube_texel(c.y, size);
    int right = rg_imin(x + 1, size - 1);
    int below = rg_imin(y + 1, size - 1);
    float fx = c.x - rg_to_float(x);
    rgba upper = rgba_lerp(environment_texel(rg, x, y, c.face, level),
                           environment_texel(rg, right, y, c.face, level), fx);
    rgba lower = rgba_lerp(environment_texel(rg, x, below, c.face, level),
                           environment_texel(rg, right, below, c.face, level), fx);
    rgba light = rgba_lerp(upper, lower, c.y - rg_to_float(y));
    return v3_make(light.r, light.g, light.b);
}

#endif

#endif
